// What must hold of any bytes as a recipe: a message with its place, or a recipe whose text reads as the same recipe.
// Files in Python are not loaded.
#include <sys/mman.h>
#include <unistd.h>

#include <optional>

#include "tests/fuzz/harness.h"
#include "tools/cli/recipe.h"

using namespace wrlkit;

namespace {

/// read_recipe of a text, by way of a file that is in memory alone.
std::optional<Recipe> recipe_of(std::string_view text, std::string& why) {
  const int fd = memfd_create("recipe", 0);
  require(fd >= 0 && write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size()), "no memory for a file");
  const auto path = "/proc/self/fd/" + std::to_string(fd);
  const bool python = text.find("python") != text.npos || text.find('\\') != text.npos;
  auto recipe = python ? read_recipe_options(path, why) : read_recipe(path, why);
  close(fd);
  return recipe;
}

std::string text_of(const Recipe& recipe) {
  std::string why;
  const auto pipeline = Pipeline::parse(recipe.pipeline.value_or(""), why);
  require(pipeline.has_value(), "a recipe with a pipeline that is none: " + why);
  return recipe_text(recipe.options, recipe.warnings, *pipeline);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string why;
  const auto recipe = recipe_of(text_of(data, size), why);
  require(recipe.has_value() == why.empty(), "neither a recipe nor why not, or both");
  if (!recipe) return 0;
  const auto text = text_of(*recipe);
  const auto again = recipe_of(text, why);
  require(again.has_value(), "what was written is not read: " + why + text);
  require(text_of(*again) == text, "what was written reads as another recipe\n" + text + "\nthen\n" + text_of(*again));
  return 0;
}

// Recipes: what -p and the options of convert and corpus run say, as a TOML file that can be kept next to the scenes.
//
//   summary = "plant for the web"
//   [input]                  # what the scenes are: unit = "mm", up = "z", include = ["*.wrl"]
//   [output]                 # what is made of them: every other option of convert
//   [limits]                 # timeout = "2m", memory = "4G"
//   [messages]               # error = ["url-not-found"], ignore = ["unknown-field"], strict = true
//   python = ["tags.py"]     # files with passes in Python, from the folder of the recipe
//   [[pass]]                 # the pipeline, pass by pass; or in one line: pipeline = "weld,join"
//   name = "weld"
//   tolerance = "auto"
//
// Nothing is described here: a key of a section is an option of the command line of that name, and what stands below
// [[pass]] are options of that pass. So a recipe can say what the command line can, and nothing else.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wrlkit {

class Pipeline;

/// Options by their long names without "--", with what was given for each.
using GivenOptions = std::vector<std::pair<std::string, std::vector<std::string>>>;

struct Recipe {
  std::string path, summary;
  std::vector<std::string> python;      // files with passes, as absolute paths
  std::optional<std::string> pipeline;  // in one line
  GivenOptions options;                 // of convert and of corpus run
  std::vector<std::string> warnings;    // as behind -W: "error=unknown-field"
};

/// Which section of a recipe has an option of the command line; empty: in none, for it does not belong to a
/// recipe.
std::string_view recipe_section(std::string_view option);

/// Null when it is missing or not a recipe: `why` is a message with file, line, column and the line itself.
/// Files in Python are loaded, for passes have to be known; throws NeedsPython (python_passes.h).
std::optional<Recipe> read_recipe(const std::string& path, std::string& why);
/// Only the options, of a recipe that a run has written down: its passes need not be known.
std::optional<Recipe> read_recipe_options(const std::string& path, std::string& why);

/// The recipe that says what these options and this pipeline say. Reading it gives them again.
std::string recipe_text(const GivenOptions& options, const std::vector<std::string>& warnings,
                        const Pipeline& pipeline);

/// The sections, their keys and the passes: docs/recipes.md.
std::string recipes_page();

}  // namespace wrlkit

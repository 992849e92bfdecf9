// What must hold of any bytes as a patch file: the reader gives a set whose lists fit together; written and read again
// it is written as the same text; its world passes through the checks.
#include "parsers/patches/patches.h"
#include "parsers/patches/patches_scene.h"
#include "tests/fuzz/harness.h"
#include "writers/patches/patches.h"

using namespace wrlkit;

namespace {

std::string patches_text(const PatchSet& set) {
  std::string text;
  write_patches(set, [&](std::string_view s) { text += s; });
  return text;
}

void check_lists(const PatchSet& set) {
  std::size_t triangles = 0, patches = 0;
  for (std::size_t s = 0; s < set.shapes.size(); ++s) {
    require(set.shapes[s].first_triangle == triangles, "triangles lie outside of shapes");
    triangles += set.triangles_of(s).size();
  }
  for (std::size_t t = 0; t < set.triangles.size(); ++t) {
    require(set.triangles[t].first_patch == patches, "patches lie outside of triangles");
    patches += set.patches_of(t).size();
  }
  require(triangles == set.triangles.size() && patches == set.patches.size(), "the lists do not end together");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diag;
  const auto set = parse_patches(text_of(data, size), "fuzz", diag);
  say_all(diag);
  if (!set) return 0;
  check_lists(*set);
  const auto first = patches_text(*set);
  Diagnostics silent;
  const auto again = parse_patches(first, "again", silent);
  require(again.has_value() && !silent.has_errors(), "what was written is not read");
  require(patches_text(*again) == patches_text(*parse_patches(patches_text(*again), "again", silent)),
          "written twice, not the same");
  require(again->patches.size() == set->patches.size(), "patches are lost on the way");
  Scene scene;
  add_patches(*set, scene);
  check_values(scene, diag);
  return 0;
}

// For every world of VRML97 or VRML 1.0 below some folders: what is written reads back as the same scene, and written
// again it is the same text. Says of each world that breaks this what differs, and fails.
//
//   roundtrip FOLDER...    --found: the corpus of the folder WRLKIT_SHARED, or of ../shared. Ends with 77 where a
//   folder
//                          is not there
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "parsers/parsers.h"
#include "scenegraph/equal.h"
#include "tests/roundtrip/worlds.h"
#include "writers/vrml/vrml.h"

using namespace wrlkit;

namespace {

std::string text_of(const Scene& scene) {
  Diagnostics diag;
  std::string text;
  write_vrml(
      scene, {.own_fields = true}, [&](std::string_view s) { text += s; }, diag);
  return text;
}

/// The first line in which two texts differ.
std::string first_difference(std::string_view a, std::string_view b) {
  auto at = static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
  auto line = static_cast<std::size_t>(std::ranges::count(a.substr(0, at), '\n')) + 1;
  return "line " + std::to_string(line) + " of the second text differs";
}

/// What the text of a scene does not keep of it; empty when nothing is lost.
std::string lost(const Scene& scene) {
  Diagnostics diag;
  const auto text = text_of(scene);
  auto again = parse_world(text, "again", {}, diag);
  if (!again) return "what was written is not read";
  if (diag.has_errors()) {
    auto at = std::ranges::find(diag.messages(), Severity::error, &Message::severity);
    auto place = diag.sources().locate(at->where);
    return "line " + std::to_string(place.line) + " of what was written: " + at->text() + ": " + place.line_text;
  }
  if (auto other = difference(scene, again->scene); !other.empty()) return other;
  const auto second = text_of(again->scene);
  return second == text ? std::string() : first_difference(text, second);
}

struct Count {
  int worlds = 0, faulty = 0;
};

void check_folder(const std::string& folder, Count& count) {
  for (const auto& path : files_below(folder)) {
    Diagnostics diag;
    auto world = read_world(path, {}, diag);
    if (!world || (world->format != Format::vrml97 && world->format != Format::vrml1)) continue;
    ++count.worlds;
    if (auto fault = lost(world->scene); !fault.empty()) {
      ++count.faulty;
      std::printf("%s: %s\n", path.c_str(), fault.c_str());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto folders = folders_of(argc, argv);
  if (folders.empty()) return skipped;
  Count count;
  for (const auto& folder : folders) check_folder(folder, count);
  std::printf("%d worlds, %d of them come back otherwise\n", count.worlds, count.faulty);
  return count.worlds == 0 || count.faulty ? 1 : 0;
}

// The pages that `view` writes: the viewer (viewer/, built by Vite and linked into the program as HTML texts) with the
// scenes that it shows, or for a tileset. What is in the page is read by viewer/src/data.ts and tiles_main.ts.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/io/sink.h"
#include "geometry/deviation.h"

namespace wrlkit {

struct ViewerPage {
  struct World {
    std::string name;  // of the file
    std::string glb;
  };
  /// A progressive world (docs/progressive.md).
  struct Collapse {
    std::string criterion, wpm;
  };

  std::vector<World> worlds;  // one, or two to be compared
  std::vector<Collapse> collapses;
  /// The deviation of the two scenes; the maps of each from the other (tools/report/deviation_map.h).
  struct Apart {
    Deviation deviation;
    std::array<std::string, 2> maps;
  };
  std::optional<Apart> apart;
};

/// False when this program was built without Node.js; pages cannot be written then.
bool has_viewer();

/// One HTML file. The data are packed (gzip) and written as base64.
void write_viewer_page(const ViewerPage&, const Sink&);

/// The page of a tileset, which it loads from `tileset`: an address, as seen from the page.
void write_tiles_page(const std::string& name, const std::string& tileset, const Sink&);

}  // namespace wrlkit

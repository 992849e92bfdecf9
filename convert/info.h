// What is inside a scene.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "convert/document.h"
#include "convert/forms_census.h"
#include "convert/geometry_census.h"

namespace wrlkit {

struct TextureInfo {
  std::string url;
  bool found = false;
  int width = 0, height = 0;
};

/// Counts are of the world as shown: instances multiplied out, finest level of detail, chosen child of a Switch.
struct Info {
  Format format = Format::none;
  bool gzip = false;
  bool is_inventor = false;                    // of VRML 1.0: the language that it is a part of
  std::uint64_t bytes = 0;                     // on disk
  std::map<std::string, std::uint64_t> nodes;  // authored, each once
  GeometryCensus geometry;
  std::uint64_t materials = 0, lights = 0, viewpoints = 0, lods = 0, animations = 0, protos = 0, routes = 0,
                scripts = 0, inlines = 0, names = 0;
  std::vector<TextureInfo> textures;
  std::vector<std::uint64_t> levels;  // triangles with every LOD at its first level, its second, ...
  std::optional<FormsCensus> forms;   // when it was asked for
};

struct InfoOptions {
  bool recognise = false;  // what the parts are, too
};

/// Nothing when the scene cannot be expanded; messages() of the document say why. Prototypes and Inlines are expanded
/// in a copy. O(scene), and every geometry is tessellated once for the world and once more for each level of its LODs.
std::optional<Info> info(const Document&, const InfoOptions& = {});
/// The same without the copy: the document is expanded.
std::optional<Info> info(Document&&, const InfoOptions& = {});

}  // namespace wrlkit

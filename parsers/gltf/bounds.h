// The sphere around what a node of glTF shows, by the bounds that accessors say.
#pragma once
#include "parsers/gltf/file.h"
#include "scenegraph/value.h"

namespace wrlkit::gltf_reader {

struct Ball {
  Vec3 center{0, 0, 0};
  double radius = 0;  // 0: nothing is known
};

/// In the frame of the node's parent. Linear in the nodes below, each once.
Ball bounds_below(File&, std::uint32_t node);

}  // namespace wrlkit::gltf_reader

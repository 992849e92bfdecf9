// KHR_animation_pointer: which fields of VRML a property of glTF has become.
#pragma once
#include <functional>
#include <vector>

#include "parsers/gltf/hierarchy.h"

namespace wrlkit::gltf_reader {

/// One field that follows some of the numbers of a property.
struct Follower {
  NodeId node;
  std::string_view event;
  bool color = false;            // three numbers, linear; otherwise one
  std::size_t at = 0;            // the first of them
  double scale = 1, offset = 0;  // of a number
};

struct Pointed {
  std::size_t width = 0;  // numbers of the property; 0: nothing of it has a counterpart
  std::vector<Follower> followers;
};

/// Colours and opacity of materials, colour and intensity of lights, the angle of cameras.
Pointed followers_of(const Context&, const Hierarchy&, const Meshes&, std::string_view pointer);

/// "/nodes/3/rotation": the node and its path. Nothing of other pointers.
std::optional<std::pair<std::uint32_t, std::string_view>> node_path(std::string_view pointer);

}  // namespace wrlkit::gltf_reader

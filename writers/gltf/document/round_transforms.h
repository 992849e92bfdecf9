// Numbers of nodes with as few digits as a tolerance allows: most of the JSON of a large world is such numbers.
#pragma once
#include <functional>

#include "writers/gltf/document/document.h"

namespace wrlkit::gltf {

struct RoundingRules {
  double tolerance;                                 // metres of the world that nothing moves further
  std::function<double(std::uint32_t mesh)> reach;  // how far a mesh goes from its origin
  std::function<bool(NodeId source)> moves = [](NodeId) { return false; };  // animated: stays as it is
};

/// How far anything may have moved; 0 when no number of digits is good enough, and nothing was changed.
double round_transforms(Document&, const RoundingRules&);

}  // namespace wrlkit::gltf

// The prototypes that a file of the scene would have.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

/// From the outside inwards; others are left over from instances that were expanded. O(prototypes).
inline std::vector<ProtoId> declared_protos(const Scene& scene) {
  std::vector<ProtoId> out = scene.main.protos;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto& inner = scene.proto(out[i]).body.protos;
    out.insert(out.end(), inner.begin(), inner.end());
  }
  return out;
}

}  // namespace wrlkit

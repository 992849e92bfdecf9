// A node of its own for one of those that share it.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit::bake {

/// Of the same type, with the same fields and without a name.
inline NodeId copy_of(Scene& scene, NodeId n) {
  const NodeId copy = scene.add(scene.type_id(n), scene.where(n));
  const auto fields = scene.copy_of_fields(n);
  scene.set_fields(copy, fields);
  return copy;
}

}  // namespace wrlkit::bake

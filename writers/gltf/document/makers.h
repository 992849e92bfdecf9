// What the nodes of a file are made from, and what is made along with them.
#pragma once
#include "writers/gltf/animations.h"
#include "writers/gltf/gltf.h"
#include "writers/gltf/meshes.h"

namespace wrlkit::gltf {

struct Makers {
  const Scene& scene;
  const GltfOptions& options;
  Meshes& meshes;
  Materials& materials;
  Animations& animations;
  Extras* extras;  // none: without
  Diagnostics& diag;

  /// Whether the file says which VRML it comes from, so that it can be made again.
  bool keeps_everything() const { return extras && !options.facts_only; }
};

}  // namespace wrlkit::gltf

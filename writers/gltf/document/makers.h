// What the nodes of a file are made from, and what is made along with them.
#pragma once
#include "scenegraph/nodes.h"
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

  /// Whether children that a Switch does not show are nodes all the same.
  bool keeps_hidden(NodeId switch_node) const {
    return options.hidden == GltfOptions::Hidden::invisible ||
           animations.events().sets(switch_node, nodes::switch_::whichChoice.slot);
  }
  /// Whether the file says which VRML it comes from, so that it can be made again.
  bool keeps_everything() const { return extras && !options.facts_only; }
};

}  // namespace wrlkit::gltf

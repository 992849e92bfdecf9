// The meshes that a stage needs, each taken in once: by geometry node, and for Box, Cone, Cylinder and Sphere by what
// they are, because the atoms of a molecule are a hundred thousand nodes and a handful of spheres.
#pragma once
#include <map>
#include <vector>

#include "base/diagnostics.h"
#include "light/render/mesh_pool.h"
#include "light/render/stage.h"

namespace wrlkit::drawing {

class Gatherer {
 public:
  Gatherer(const Scene& scene, const MeshSource& source, MeshPool& pool)
      : scene_(scene), source_(source), pool_(pool) {}

  /// The mesh of each of stage.uses. When there are more than MeshPool::most_elements, the rest are empty.
  std::vector<std::uint32_t> meshes_of(const Stage& stage, Diagnostics& diag);

 private:
  std::uint32_t mesh_of(NodeId geometry);
  bool is_primitive(NodeId geometry) const;
  std::vector<double> description(NodeId primitive) const;

  const Scene& scene_;
  const MeshSource& source_;
  MeshPool& pool_;
  std::vector<std::uint32_t> of_node_;
  std::map<std::vector<double>, std::uint32_t> of_primitive_;
};

/// The box around all uses.
Box bounds(const Stage& stage, const MeshPool& pool, std::span<const std::uint32_t> mesh_of);

}  // namespace wrlkit::drawing

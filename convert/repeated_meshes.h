// The meshes of geometry that a file has again and again are made once.
#pragma once
#include <vector>

#include "base/task.h"
#include "convert/meshes_ahead.h"
#include "geometry/equal_geometry.h"
#include "geometry/mesh.h"

namespace wrlkit {

/// A source of meshes, and which of them are alike. A mesh counts as a repeated one only where nothing was said or
/// counted when the first was made, no ROUTE or script moves either, and both are shown with a texture or without.
class RepeatedMeshes {
 public:
  /// `geometries` in the order in which they will be asked for, nearly.
  RepeatedMeshes(const Scene&, const MeshSource&, const MeshMakers&, const VertexMaker&,
                 std::span<const NodeId> geometries, Task&);

  const Mesh& operator()(NodeId);
  /// The vertices of the mesh that was given last, where they were made ahead for this geometry; null: they were not,
  /// or were taken before.
  Vertices* take_vertices(NodeId);
  bool is_textured(NodeId n) const { return textured_[n.value] != 0; }
  /// A geometry that was asked for before and has the same mesh; none if there is none.
  NodeId same_mesh(NodeId);

 private:
  bool is_still(NodeId n) const { return n.value < driven_.size() && !driven_[n.value]; }
  std::uint64_t n_said() const;
  const Mesh& make(NodeId);

  const MeshSource& source_;
  Task& task_;
  EqualGeometry equal_;
  std::vector<char> driven_, textured_, asked_;  // by node
  MeshesAhead ahead_;
  NodeId given_;  // whose mesh was made ahead and given last
  MeshesAhead::Known* known_ = nullptr;
};

}  // namespace wrlkit

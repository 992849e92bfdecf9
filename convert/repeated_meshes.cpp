#include "convert/repeated_meshes.h"

#include "geometry/geometry.h"
#include "scenegraph/driven.h"

namespace wrlkit {

RepeatedMeshes::RepeatedMeshes(const Scene& scene, const MeshSource& source, const MeshMakers& makers,
                               const VertexMaker& vertices, std::span<const NodeId> geometries, Task& task)
    : source_(source),
      task_(task),
      equal_(scene),
      driven_(driven_geometry(scene)),
      textured_(textured_geometry(scene)),
      asked_(scene.node_count()),
      ahead_(scene, makers, vertices) {
  std::vector<NodeId> still(geometries.begin(), geometries.end());
  std::erase_if(still, [&](NodeId n) { return !is_still(n); });
  ahead_.begin(still, textured_);
}

/// It grows with every message and everything that is counted.
std::uint64_t RepeatedMeshes::n_said() const {
  std::uint64_t n = task_.diag.count();
  for (const auto& [name, count] : task_.stats) n += count;
  return n;
}

const Mesh& RepeatedMeshes::make(NodeId n) {
  auto* known = ahead_.find(n);
  if (!known || !known->done) return source_(n);
  for (const auto& [name, count] : known->counted) task_.stats[name] += count;
  given_ = n;
  known_ = known;
  return known->mesh;
}

Vertices* RepeatedMeshes::take_vertices(NodeId n) {
  auto* known = std::exchange(known_, nullptr);
  return known && given_ == n ? &known->vertices : nullptr;
}

const Mesh& RepeatedMeshes::operator()(NodeId n) {
  known_ = nullptr;
  const bool first = is_still(n) && !asked_[n.value];
  if (!first) return source_(n);
  asked_[n.value] = 1;
  const auto before = n_said();
  const Mesh& mesh = make(n);
  if (n_said() == before) equal_.add(n);
  return mesh;
}

NodeId RepeatedMeshes::same_mesh(NodeId n) {
  known_ = nullptr;
  if (!is_still(n) || asked_[n.value]) return {};
  if (const auto* known = ahead_.find(n)) equal_.know(n, known->hash, known->same);
  const NodeId other = equal_.find(n);
  return other && textured_[other.value] == textured_[n.value] ? other : NodeId{};
}

}  // namespace wrlkit

#include "passes/merge/named_mesh.h"

#include "scenegraph/nodes.h"

namespace wrlkit {

bool NamedMesh::add(const Mesh& mesh, const Matrix& frame, std::string_view name, StampedMap& map) {
  const auto before = mesh_.face_begin.empty() ? 0 : mesh_.face_begin.size() - 1;
  if (!append_moved(mesh_, mesh, frame, map)) return false;
  const auto now = mesh_.face_begin.empty() ? 0 : mesh_.face_begin.size() - 1;
  const auto added = static_cast<std::int32_t>(now - before);
  if (!names_.empty() && names_.back() == name) {
    faces_.back() += added;
    return true;
  }
  names_.push_back(name);
  faces_.push_back(added);
  return true;
}

NodeId NamedMesh::add_geometry(Scene& scene) const {
  return scene.add(mesh_.kind == Mesh::Kind::lines    ? nodes::IndexedLineSet
                   : mesh_.kind == Mesh::Kind::points ? nodes::PointSet
                                                      : nodes::IndexedFaceSet);
}

}  // namespace wrlkit

// Meshes that become one, in which each part is still known by its name.
#pragma once
#include <string_view>
#include <vector>

#include "geometry/moved.h"
#include "scenegraph/features.h"

namespace wrlkit {

class NamedMesh {
 public:
  /// What follows something of the same name is of that part. The name must outlive this. As append_moved.
  bool add(const Mesh& mesh, const Matrix& frame, std::string_view name, StampedMap& map);

  const Mesh& mesh() const { return mesh_; }
  Mesh take() { return std::move(mesh_); }
  Features parts() const { return {names_, faces_}; }
  /// A node that fits the kind of mesh, without it.
  NodeId add_geometry(Scene& scene) const;

 private:
  Mesh mesh_;
  std::vector<std::string_view> names_;
  std::vector<std::int32_t> faces_;
};

}  // namespace wrlkit

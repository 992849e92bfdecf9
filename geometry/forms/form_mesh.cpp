#include "geometry/forms/form_mesh.h"

namespace wrlkit {

FormMesh::FormMesh(const Matrix& frame, Mesh& mesh) : frame_(frame), mesh_(mesh), positions_(mesh.positions.edit()) {
  mesh.kind = Mesh::Kind::faces;
  mesh.primitive = true;
  mesh.face_begin.push_back(0);
}

std::uint32_t FormMesh::position(const Vec3& p) {
  const Vec3 q = frame_.point(p);
  positions_.insert(positions_.end(), q.begin(), q.end());
  return static_cast<std::uint32_t>(positions_.size() / 3 - 1);
}

std::uint32_t FormMesh::normal(const Vec3& n) {
  Vec3 q{};
  for (int r = 0; r < 3; ++r)
    q[static_cast<std::size_t>(r)] = frame_(r, 0) * n[0] + frame_(r, 1) * n[1] + frame_(r, 2) * n[2];
  const double length = std::hypot(q[0], q[1], q[2]);
  for (double v : q) mesh_.normal.values.push_back(static_cast<float>(length > 0 ? v / length : 0));
  return static_cast<std::uint32_t>(mesh_.normal.count() - 1);
}

void FormMesh::corner(std::uint32_t position, std::uint32_t normal) {
  mesh_.corners.push_back(position);
  mesh_.normal.index.push_back(normal);
}

void FormMesh::end_face() {
  const auto end = static_cast<std::uint32_t>(mesh_.corners.size());
  triangles_ &= end - mesh_.face_begin.back() == 3;
  mesh_.face_begin.push_back(end);
}

void FormMesh::band(const Ring& low, const Ring& high, bool closed) {
  const std::size_t n = low.positions.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t k = (i + 1) % n;
    corner(low.positions[i], low.normals[i]);
    if (low.positions[k] != low.positions[i]) corner(low.positions[k], low.normals[k]);
    corner(high.positions[k], high.normals[k]);
    if (high.positions[k] != high.positions[i]) corner(high.positions[i], high.normals[i]);
    end_face();
  }
}

void FormMesh::cap(const std::vector<std::uint32_t>& positions, const Vec3& n, bool reversed) {
  const auto number = normal(n);
  const std::size_t count = positions.size();
  for (std::size_t i = 0; i < count; ++i) corner(positions[reversed ? count - 1 - i : i], number);
  end_face();
}

void FormMesh::finish() {
  if (triangles_) mesh_.face_begin.clear();
}

}  // namespace wrlkit

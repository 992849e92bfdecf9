// Writes the faces of a primitive into a Mesh, corner by corner, with all three index streams.
#pragma once
#include <cstdint>

#include "geometry/mesh.h"

namespace wrlkit {

class FaceWriter {
 public:
  explicit FaceWriter(Mesh& mesh) : mesh_(mesh), positions_(mesh.positions.edit()) {
    mesh.kind = Mesh::Kind::faces;
    mesh.primitive = true;
    mesh.face_begin.push_back(0);
  }

  std::uint32_t position(double x, double y, double z) {
    positions_.insert(positions_.end(), {x, y, z});
    return static_cast<std::uint32_t>(positions_.size() / 3 - 1);
  }
  std::uint32_t normal(double x, double y, double z) { return add(mesh_.normal, {float(x), float(y), float(z)}); }
  std::uint32_t texcoord(double s, double t) { return add(mesh_.texcoord, {float(s), float(t)}); }

  void corner(std::uint32_t position, std::uint32_t normal, std::uint32_t texcoord) {
    mesh_.corners.push_back(position);
    mesh_.normal.index.push_back(normal);
    mesh_.texcoord.index.push_back(texcoord);
  }

  void end_face() {
    auto end = static_cast<std::uint32_t>(mesh_.corners.size());
    triangles_ &= end - mesh_.face_begin.back() == 3;
    mesh_.face_begin.push_back(end);
  }

  /// To be called once, at the end: face_begin does not list triangles.
  void finish() {
    if (triangles_) mesh_.face_begin.clear();
  }

 private:
  static std::uint32_t add(Attribute& a, std::initializer_list<float> v) {
    a.values.insert(a.values.end(), v);
    return static_cast<std::uint32_t>(a.count() - 1);
  }

  Mesh& mesh_;
  std::vector<double>& positions_;
  bool triangles_ = true;
};

}  // namespace wrlkit

#include "passes/weld/surface.h"

namespace wrlkit {

void Surface::number_faces() const {
  face_of.resize(mesh.corners.size());
  for (std::uint32_t f = 0; f < n_faces(); ++f) std::fill(face_of.begin() + begin(f), face_of.begin() + end(f), f);
}

Vec3 Surface::area_vector(std::uint32_t f) const {
  auto corners = face(f);
  Vec3 sum{}, last{}, origin = point(corners[0]);
  for (std::uint32_t p : corners.subspan(1)) {
    Vec3 d = point(p) - origin;
    sum = sum + cross(last, d);
    last = d;
  }
  return sum;
}

void take_corners(Mesh& mesh, std::span<const std::uint32_t> corners, std::vector<std::uint32_t>& room) {
  for_each_stream(mesh, [&](std::vector<std::uint32_t>& stream) {
    room.resize(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) room[i] = stream[corners[i]];
    stream.swap(room);
  });
}

}  // namespace wrlkit

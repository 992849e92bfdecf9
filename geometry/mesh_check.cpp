#include "geometry/mesh_check.h"

namespace wrlkit {

std::string breach_of(const Mesh& m) {
  const auto beyond = [](std::span<const std::uint32_t> index, std::size_t count) {
    return std::ranges::any_of(index, [&](std::uint32_t i) { return i >= count; });
  };
  if (m.positions.size() % 3 != 0) return "positions that are not whole points";
  if (beyond(m.corners, m.n_positions())) return "a corner without a position";
  if (m.face_begin.empty() && m.corners.size() % m.corners_per_face() != 0) return "a face that is not whole";
  if (!m.face_begin.empty() && (m.face_begin.front() != 0 || m.face_begin.back() != m.corners.size()))
    return "faces that do not hold all corners";
  if (!std::ranges::is_sorted(m.face_begin)) return "faces that overlap";
  for (const Attribute* a : m.attributes()) {
    if (!a->present()) continue;
    if (a->index.size() != m.corners.size()) return "an attribute that not every corner has";
    if (beyond(a->index, a->count())) return "a corner without its value of an attribute";
  }
  return {};
}

}  // namespace wrlkit

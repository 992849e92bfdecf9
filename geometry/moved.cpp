#include "geometry/moved.h"

#include <algorithm>
#include <limits>

namespace wrlkit {
namespace {

constexpr std::size_t most_indices = std::numeric_limits<std::int32_t>::max() / 2;  // with room for the -1

}  // namespace

bool append_moved(Mesh& all, const Mesh& m, const Matrix& frame, StampedMap& map) {
  if (all.corners.size() + m.corners.size() > most_indices) return false;
  if (all.kind == Mesh::Kind::none) {
    all.kind = m.kind;
    all.solid = m.solid;
    all.color.width = m.color.width;
    all.face_begin.push_back(0);
  }
  all.convex &= m.convex;
  const bool reversed = m.kind == Mesh::Kind::faces && m.ccw == (frame.determinant() < 0);
  const double sign = frame.determinant() < 0 ? -1 : 1;
  const auto first_corner = static_cast<std::uint32_t>(all.corners.size());
  // Points in the order in which corners use them, so that those of a part stand together.
  auto& points = all.positions.edit();
  map.reset(m.n_positions());
  auto take = [&](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& to, auto&& make) {
    for (std::size_t f = 0; f < m.n_faces(); ++f)
      for (std::size_t begin = m.begin_of(f), end = m.end_of(f), c = begin; c < end; ++c) {
        const auto v = from[reversed && c > begin ? begin + end - c
                                                  : c];  // from the same corner on, so that it is cut in the same way
        if (!map.contains(v)) map.set(v, make(v));
        to.push_back(map[v]);
      }
  };
  take(m.corners, all.corners, [&](std::uint32_t v) {
    const double* p = m.positions.data() + std::size_t{v} * 3;
    Vec3 at = frame.point({p[0], p[1], p[2]});
    const double noise = 1e-15 * std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
    for (double& x : at)
      if (std::abs(x) < noise) x = 0;
    points.insert(points.end(), at.begin(), at.end());
    return static_cast<std::uint32_t>(points.size() / 3 - 1);
  });
  for (std::size_t f = 0; f < m.n_faces(); ++f)
    all.face_begin.push_back(first_corner + static_cast<std::uint32_t>(m.end_of(f)));
  for (auto a : {&Mesh::normal, &Mesh::color, &Mesh::texcoord}) {
    const Attribute& from = m.*a;
    Attribute& to = all.*a;
    if (!from.present()) continue;
    map.reset(from.count());
    take(from.index, to.index, [&](std::uint32_t v) {
      const float* p = from.at(v);
      if (a != &Mesh::normal) {
        to.values.insert(to.values.end(), p, p + from.width);
        return static_cast<std::uint32_t>(to.count() - 1);
      }
      std::array<double, 3> n{};
      for (int r = 0; r < 3; ++r) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3;
        for (int c = 0; c < 3; ++c)
          n[static_cast<std::size_t>(r)] +=
              sign * p[c] *
              (frame(r1, (c + 1) % 3) * frame(r2, (c + 2) % 3) - frame(r1, (c + 2) % 3) * frame(r2, (c + 1) % 3));
      }
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (double v : n) to.values.push_back(static_cast<float>(length > 0 ? v / length : 0));
      return static_cast<std::uint32_t>(to.count() - 1);
    });
  }
  return true;
}

}  // namespace wrlkit

#include <algorithm>
#include <array>
#include <limits>

#include "geometry/tessellation.h"

namespace wrlkit {
namespace {

struct Bounds {
  Vec3 low, high;
  double half(std::size_t axis) const { return high[axis] / 2 - low[axis] / 2; }  // of its length, which could overflow
};

Bounds bounds_of_corners(const Mesh& mesh) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Bounds b{{far, far, far}, {-far, -far, -far}};
  const double* positions = mesh.positions.data();
  for (auto p : mesh.corners)
    for (std::size_t k = 0; k < 3; ++k) {
      const double v = positions[std::size_t{p} * 3 + k];
      b.low[k] = std::min(b.low[k], v);
      b.high[k] = std::max(b.high[k], v);
    }
  return b;
}

// S and T of a point.
struct Projection {
  Bounds bounds;
  std::array<std::size_t, 3> axes{0, 1, 2};  // longest first

  explicit Projection(const Bounds& b) : bounds(b) {
    std::ranges::stable_sort(axes, [&](auto x, auto y) { return b.half(x) > b.half(y); });
  }

  void project(const double* p, float* out) const {
    const double longest = bounds.half(axes[0]);
    for (std::size_t k = 0; k < 2; ++k)
      out[k] = longest > 0 ? static_cast<float>((p[axes[k]] / 2 - bounds.low[axes[k]] / 2) / longest) : 0;
  }
};

}  // namespace

void default_texcoords(Mesh& mesh) {
  if (mesh.kind != Mesh::Kind::faces || mesh.corners.empty() || mesh.texcoord.present()) return;
  const Projection projection(bounds_of_corners(mesh));
  const double* positions = mesh.positions.data();
  auto& [values, index, width] = mesh.texcoord;
  if (mesh.n_positions() <= mesh.corners.size()) {
    values.resize(2 * mesh.n_positions());
    for (std::size_t p = 0; p < mesh.n_positions(); ++p) projection.project(positions + 3 * p, &values[2 * p]);
    index = mesh.corners;
  } else {  // most points belong to other shapes: a value for each corner
    values.resize(2 * mesh.corners.size());
    index.resize(mesh.corners.size());
    for (std::size_t c = 0; c < index.size(); ++c) {
      projection.project(positions + std::size_t{mesh.corners[c]} * 3, &values[2 * c]);
      index[c] = static_cast<std::uint32_t>(c);
    }
  }
}

}  // namespace wrlkit

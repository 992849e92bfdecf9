#include <algorithm>
#include <array>
#include "base/math/box.h"

#include "geometry/tessellation.h"

namespace wrlkit {
namespace {

/// Half of the length, as the length itself could overflow.
double half(const Box& b, std::size_t axis) { return b.high[axis] / 2 - b.low[axis] / 2; }

// S and T of a point.
struct Projection {
  Box box;
  std::array<std::size_t, 3> axes{0, 1, 2};  // longest first

  explicit Projection(const Box& b) : box(b) {
    std::ranges::stable_sort(axes, [&](auto x, auto y) { return half(b, x) > half(b, y); });
  }

  void project(const double* p, float* out) const {
    const double longest = half(box, axes[0]);
    for (std::size_t k = 0; k < 2; ++k)
      out[k] = longest > 0 ? static_cast<float>((p[axes[k]] / 2 - box.low[axes[k]] / 2) / longest) : 0;
  }
};

}  // namespace

void default_texcoords(Mesh& mesh) {
  if (mesh.kind != Mesh::Kind::faces || mesh.corners.empty() || mesh.texcoord.present()) return;
  const Projection projection(box_of_corners(mesh));
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

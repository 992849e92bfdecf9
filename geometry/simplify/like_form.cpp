#include "geometry/simplify/like_form.h"

#include <algorithm>

#include "base/hashing.h"
#include "base/math/affine.h"
#include "base/math/eigen.h"

namespace wrlkit::simplify {
namespace {

constexpr double of_extent = 2e-3, of_thickness = 0.05;  // what rounding may do
constexpr double most_stretch = 2;

/// The position for which `size` is largest.
std::uint32_t farthest(const Triangles& surface, std::size_t n, const auto& size) {
  std::uint32_t best = 0;
  double most = -1;
  for (std::uint32_t i = 0; i < n; ++i)
    if (const double s = size(surface.position(i)); s > most) {
      most = s;
      best = i;
    }
  return best;
}

double squared(const Vec3& v) { return dot(v, v); }

bool is_even(const Matrix& m) {
  std::array<std::array<double, 3>, 3> products, vectors;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      products[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = dot(m.column(r), m.column(c));
  std::array<double, 3> values;
  diagonalise(products, vectors, values);
  const auto [least, most] = std::ranges::minmax(values);
  return most <= most_stretch * most_stretch * least;
}

}  // namespace

std::uint64_t hash_of_corners(const Mesh& mesh) {
  std::uint64_t h = mesh.n_positions();
  for (auto c : mesh.corners) h = mixed(h, c);
  return h;
}

LikeForm::LikeForm(Mesh mesh) : mesh_(std::move(mesh)) {
  const auto surface = triangles_of(mesh_);
  const auto n = mesh_.n_positions();
  if (n < 3) return;
  const Vec3 o = surface.position(0);
  at_[1] = farthest(surface, n, [&](const Vec3& p) { return squared(p - o); });
  const Vec3 x = surface.position(at_[1]) - o;
  at_[2] = farthest(surface, n, [&](const Vec3& p) { return squared(cross(x, p - o)); });
  const Vec3 normal = cross(x, surface.position(at_[2]) - o);
  at_[3] = farthest(surface, n, [&](const Vec3& p) { return std::abs(dot(normal, p - o)); });
  const double thickness = std::abs(dot(unit(normal), surface.position(at_[3]) - o));
  flat_ = !(thickness > of_extent * fast_length(x));
  if (const auto frame = frame_of(surface)) back_ = inverse(*frame);
}

/// Its columns go from the first of the four points to the others; across what is flat, as far as that is wide.
std::optional<Matrix> LikeForm::frame_of(const Triangles& surface) const {
  const Vec3 o = surface.position(at_[0]), x = surface.position(at_[1]) - o, y = surface.position(at_[2]) - o;
  const Vec3 normal = cross(x, y);
  const Vec3 z = flat_ ? std::sqrt(fast_length(normal)) * unit(normal) : surface.position(at_[3]) - o;
  const Matrix m = matrix_of_columns(x, y, z, o);
  const double width = fast_length(normal) / std::max(fast_length(x), 1e-300);
  if (!is_invertible(m) || !(width > of_extent * fast_length(x))) return std::nullopt;
  return m;
}

std::optional<Matrix> LikeForm::to(const Mesh& other) const {
  if (!back_ || mesh_.corners != other.corners || mesh_.n_positions() != other.n_positions()) return std::nullopt;
  const Triangles a = triangles_of(mesh_), b = triangles_of(other);
  const auto frame = frame_of(b);
  if (!frame) return std::nullopt;
  const Matrix m = *frame * *back_;
  if (!(m.determinant() > 0) || !is_even(m)) return std::nullopt;
  const Vec3 x = frame->column(0), normal = cross(x, frame->column(1));
  const double thickness = flat_ ? fast_length(normal) / fast_length(x) : std::abs(dot(unit(normal), frame->column(2)));
  const double within = std::min(of_extent * fast_length(x), of_thickness * thickness);
  for (std::uint32_t i = 0; i < mesh_.n_positions(); ++i)
    if (!(squared(m.point(a.position(i)) - b.position(i)) <= within * within)) return std::nullopt;
  return m;
}

}  // namespace wrlkit::simplify

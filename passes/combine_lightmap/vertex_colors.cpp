#include "passes/combine_lightmap/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace wrlkit::combine {
namespace {

using Color = std::array<double, 3>;
using Colors = std::vector<Color>;

/// What a place of a triangle shows.
struct Sample {
  std::array<std::uint32_t, 3> place;  // of the corners
  std::array<double, 3> weight;
  Color color;

  Color mixed(const Colors& of_place) const {
    Color out{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) out[c] += weight[k] * of_place[place[k]][c];
    return out;
  }
};

Color color_of(const Texel4& texel) { return {texel.rgba[0] / 255.0, texel.rgba[1] / 255.0, texel.rgba[2] / 255.0}; }

class Sampler {
 public:
  Sampler(const std::vector<PageTriangle>& triangles, const std::vector<Painted>& painted)
      : triangles_(triangles), painted_(painted) {}

  /// False when it was too much.
  bool run() {
    constexpr double enough = 1 << 16, most_layers = 64;
    double area = 0, boxes = 0;
    for (const PageTriangle& t : triangles_) {
      area += std::abs(t.area()) / 2;
      boxes += box_area(t);
    }
    const double step = std::max(1.0, std::sqrt(area / enough));
    if (boxes / (step * step) > most_layers * enough) return false;
    for (std::size_t i = 0; i < triangles_.size(); ++i) add(i, step);
    return true;
  }
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  static double box_area(const PageTriangle& t) {
    const auto [left, right] = std::ranges::minmax(t.x);
    const auto [top, bottom] = std::ranges::minmax(t.y);
    return (right - left + 1) * (bottom - top + 1);
  }

  /// The texels whose middles lie in it; where there are none, its own middle.
  void add(std::size_t i, double step) {
    const PageTriangle& t = triangles_[i];
    const auto [left, right] = std::ranges::minmax(t.x);
    const auto [top, bottom] = std::ranges::minmax(t.y);
    const std::size_t before = samples_.size();
    for (double y = (std::floor(top / step) + 0.5) * step; y < bottom; y += step)
      for (double x = (std::floor(left / step) + 0.5) * step; x < right; x += step) add(i, x, y);
    if (samples_.size() == before) add(i, (t.x[0] + t.x[1] + t.x[2]) / 3, (t.y[0] + t.y[1] + t.y[2]) / 3);
  }

  void add(std::size_t i, double x, double y) {
    const PageTriangle& t = triangles_[i];
    const double b = ((x - t.x[0]) * (t.y[2] - t.y[0]) - (t.x[2] - t.x[0]) * (y - t.y[0])) / t.area();
    const double c = ((t.x[1] - t.x[0]) * (y - t.y[0]) - (x - t.x[0]) * (t.y[1] - t.y[0])) / t.area();
    const std::array<double, 3> weights{1 - b - c, b, c};
    if (std::ranges::min(weights) < 0) return;
    const Painted& p = painted_[i];
    Sample s{{}, weights, color_of(p.color(weights, x, y, false))};
    for (std::uint32_t k = 0; k < 3; ++k) s.place[k] = p.mesh->lightcoord.index[p.corner + k];
    samples_.push_back(s);
  }

  const std::vector<PageTriangle>& triangles_;
  const std::vector<Painted>& painted_;
  std::vector<Sample> samples_;
};

/// What is shown at the corners themselves.
Colors at_corners(const std::vector<PageTriangle>& triangles, const std::vector<Painted>& painted,
                  std::size_t n_places) {
  Colors out(n_places);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::uint32_t k = 0; k < 3; ++k) {
      std::array<double, 3> weights{};
      weights[k] = 1;
      out[painted[i].mesh->lightcoord.index[painted[i].corner + k]] =
          color_of(painted[i].color(weights, triangles[i].x[k], triangles[i].y[k], false));
    }
  return out;
}

/// Whether each place is a corner of a triangle of the list: nothing is known of the colour of another.
bool are_all_painted(const std::vector<Painted>& painted, const Mesh& mesh) {
  std::vector<char> is_painted(mesh.lightcoord.count());
  for (const Painted& p : painted)
    for (std::uint32_t k = 0; k < 3; ++k) is_painted[mesh.lightcoord.index[p.corner + k]] = 1;
  return std::ranges::all_of(mesh.lightcoord.index, [&](std::uint32_t place) { return is_painted[place] != 0; });
}

/// The normal equations of the least squares, of all three channels at once; the wish to stay near where they start
/// holds corners that few samples know.
class Fit {
 public:
  Fit(const std::vector<Sample>& samples, std::size_t n) : samples_(samples), diagonal_(n, hold) {
    for (const Sample& s : samples)
      for (std::size_t k = 0; k < 3; ++k) diagonal_[s.place[k]] += s.weight[k] * s.weight[k];
  }

  /// Conjugate gradients, preconditioned by the diagonal.
  Colors solve(const Colors& start) const {
    constexpr int steps = 24;
    Colors change(start.size()), residual = times_transposed([&](const Sample&s) {
                                   Color out = s.color;
                                   const Color now = s.mixed(start);
                                   for (std::size_t c = 0; c < 3; ++c) out[c] -= now[c];
                                   return out;
                                 });
    Colors scaled = preconditioned(residual), direction = scaled;
    Color square = dot(residual, scaled);
    for (int i = 0; i < steps && largest(square) > tiny; ++i) {
      const Colors image = product(direction);
      const Color along = dot(direction, image);
      const Color step = ratio(square, along);
      add(change, direction, step, 1);
      add(residual, image, step, -1);
      scaled = preconditioned(residual);
      const Color next = dot(residual, scaled), turn = ratio(next, square);
      for (std::size_t p = 0; p < direction.size(); ++p)
        for (std::size_t c = 0; c < 3; ++c) direction[p][c] = scaled[p][c] + turn[c] * direction[p][c];
      square = next;
    }
    for (std::size_t p = 0; p < change.size(); ++p)
      for (std::size_t c = 0; c < 3; ++c) change[p][c] = std::clamp(start[p][c] + change[p][c], 0.0, 1.0);
    return change;
  }

 private:
  static constexpr double hold = 0.01, tiny = 1e-12;

  template <class F>
  Colors times_transposed(F&& of_sample) const {
    Colors out(diagonal_.size());
    for (const Sample& s : samples_) {
      const Color v = of_sample(s);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t c = 0; c < 3; ++c) out[s.place[k]][c] += s.weight[k] * v[c];
    }
    return out;
  }
  Colors product(const Colors& x) const {
    Colors out = times_transposed([&](const Sample& s) { return s.mixed(x); });
    add(out, x, {hold, hold, hold}, 1);
    return out;
  }
  Colors preconditioned(const Colors& x) const {
    Colors out = x;
    for (std::size_t p = 0; p < out.size(); ++p)
      for (double& v : out[p]) v /= diagonal_[p];
    return out;
  }
  static Color dot(const Colors& a, const Colors& b) {
    Color out{};
    for (std::size_t p = 0; p < a.size(); ++p)
      for (std::size_t c = 0; c < 3; ++c) out[c] += a[p][c] * b[p][c];
    return out;
  }
  static Color ratio(const Color& a, const Color& b) {
    Color out{};
    for (std::size_t c = 0; c < 3; ++c) out[c] = b[c] > 0 ? a[c] / b[c] : 0;
    return out;
  }
  static double largest(const Color& c) { return std::ranges::max(c); }
  static void add(Colors& to, const Colors& x, const Color& factor, double sign) {
    for (std::size_t p = 0; p < to.size(); ++p)
      for (std::size_t c = 0; c < 3; ++c) to[p][c] += sign * factor[c] * x[p][c];
  }

  const std::vector<Sample>& samples_;
  std::vector<double> diagonal_;
};

Difference difference(const std::vector<Sample>& samples, const Colors& colors) {
  constexpr std::size_t rare = 100;
  std::vector<double> apart;
  double square = 0;
  for (const Sample& s : samples) {
    const Color mixed = s.mixed(colors);
    for (std::size_t c = 0; c < 3; ++c) {
      apart.push_back(255 * std::abs(mixed[c] - s.color[c]));
      square += apart.back() * apart.back();
    }
  }
  if (apart.empty()) return {};
  const auto nth = apart.end() - 1 - static_cast<std::ptrdiff_t>(apart.size() / rare);
  std::ranges::nth_element(apart, nth);
  return {std::sqrt(square / static_cast<double>(apart.size())), *nth};
}

/// Texels of the light.
double texels_of(const drawing::Surface& surface, const Mesh& mesh) {
  double area = 0;
  for (std::uint32_t c = 0; c < mesh.corners.size(); c += 3)
    area += 0.5 * picture_area(mesh.lightcoord, c, surface.baked.places);
  const drawing::Texture& light = *surface.baked.light.texture;
  return area * light.width() * light.height();
}

}  // namespace

std::optional<VertexColors> fit_vertex_colors(const drawing::Surface& surface, const Mesh& mesh) {
  std::vector<PageTriangle> triangles;
  std::vector<Painted> painted;
  const drawing::Texture& light = *surface.baked.light.texture;
  list_triangles(surface, mesh, light.width(), light.height(), triangles, painted);
  Sampler sampler(triangles, painted);
  if (triangles.empty() || !are_all_painted(painted, mesh) || !sampler.run()) return {};
  VertexColors out;
  const auto start = at_corners(triangles, painted, mesh.lightcoord.count());
  out.of_place = Fit(sampler.samples(), start.size()).solve(start);
  out.error = difference(sampler.samples(), out.of_place);
  return out;
}

bool is_worth_it(const VertexColors& colors, const drawing::Surface& surface, const Mesh& mesh, std::size_t n_shapes,
                 double tolerance) {
  constexpr double of_color = 4, of_coordinates = 8, of_point = 12, of_corner = 2, of_texel = 1;  // bytes in a file
  const auto n = static_cast<double>(n_shapes), n_places = static_cast<double>(colors.of_place.size());
  const double own =
      of_point * static_cast<double>(mesh.n_positions()) + of_corner * static_cast<double>(mesh.corners.size());
  const double with_colors = of_color * n_places + (n - 1) / n * own;
  const double with_texels = of_coordinates * n_places / n + of_texel * texels_of(surface, mesh);
  constexpr double frequent = 4;  // as is_within() has it
  const double error = std::max(colors.error.mean, colors.error.most / frequent);
  return error <= 2 * tolerance && error * with_colors <= tolerance * with_texels;
}

}  // namespace wrlkit::combine

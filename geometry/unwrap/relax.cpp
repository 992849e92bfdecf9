#include "geometry/unwrap/relax.h"

#include <cmath>

namespace wrlkit::unwrap {
namespace {

/// A triangle without area goes where its points go.
double weight_of(const Triangle2& shape) {
  constexpr double least = 1e-6;
  return std::max(shape[1].x * shape[2].y, least * (dot(shape[1], shape[1]) + dot(shape[2], shape[2])));
}

}  // namespace

Stretch stretch_of(const Triangle2& s, const Triangle2& t) {
  Point2 u = t[1] - t[0], v = t[2] - t[0];
  double length = s[1].x, height = s[2].y;
  Point2 du = (1 / length) * u, dv = (1 / height) * (v - s[2].x * du);
  double e = (du.x + dv.y) / 2, f = (du.x - dv.y) / 2, g = (du.y + dv.x) / 2, h = (du.y - dv.x) / 2;
  double q = std::sqrt(e * e + h * h), r = std::sqrt(f * f + g * g);
  return {q + r, q - r};
}

void Relaxer::run(const Links& links, Flattened& chart, int steps) {
  constexpr double momentum = 0.8;
  weights_.assign(chart.points.size(), 0);
  for (std::size_t i = 0; i < chart.corner_point.size(); ++i)
    weights_[chart.corner_point[i]] += weight_of(links.shape(chart.triangles[i / 3]));
  before_ = chart.points;
  for (int step = 0; step < steps; ++step) {
    sums_.assign(chart.points.size(), {});
    for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
      Triangle2 shape = links.shape(chart.triangles[i]), t = chart.at(i);
      double weight = weight_of(shape);
      Point2 middle = (1. / 3) * (t[0] + t[1] + t[2]), own = (1. / 3) * (shape[0] + shape[1] + shape[2]);
      double c = 0, s = 0;
      for (int k = 0; k < 3; ++k) {
        shape[k] = shape[k] - own;
        c += dot(shape[k], t[k]);
        s += cross(shape[k], t[k]);
      }
      double norm = std::sqrt(c * c + s * s);
      if (!(norm > 0)) c = norm = 1;
      c /= norm;
      s /= norm;
      for (int k = 0; k < 3; ++k) {
        Point2 p{c * shape[k].x - s * shape[k].y, s * shape[k].x + c * shape[k].y};
        Point2& sum = sums_[chart.corner_point[3 * i + k]];
        sum = sum + weight * (middle + p);
      }
    }
    for (std::size_t v = 0; v < chart.points.size(); ++v) {
      if (!(weights_[v] > 0)) continue;
      Point2 old = chart.points[v];
      chart.points[v] = (1 / weights_[v]) * sums_[v] + momentum * (old - before_[v]);
      before_[v] = old;
    }
  }
}

}  // namespace wrlkit::unwrap

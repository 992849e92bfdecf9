// Points of a surface, spread evenly over its area: what a simplification of it is measured by.
#pragma once
#include <limits>
#include <span>
#include <vector>

#include "geometry/closest_point.h"

namespace wrlkit::simplify {

struct SurfaceSample {
  Vec3 point;
  double weight;  // area that it stands for
  Vec3 normal{};  // of length 1; none of a corner
  /// Squared distance of something else in the world that stays: the surface itself need not be nearer.
  double enough = std::numeric_limits<double>::infinity();
};

/// How far two surfaces are apart.
struct Distortion {
  double squares = 0;  // integral of the squared distance over both of them
  double max = 0;
};

/// About `n` points, the same ones at each run, whose weights add up to the area, and the corners (of many, some of
/// them) with little weight: it is they that stick out. Nothing for a surface without area.
std::vector<SurfaceSample> sample_surface(const Triangles& surface, std::size_t n);

/// Of a surface from the samples of another one, and back, with about `n` questions on the way back.
Distortion measure_distortion(const Triangles& surface, const ClosestPoint& nearest_on_surface,
                              std::span<const SurfaceSample> samples, const ClosestPoint& original, std::size_t n);

}  // namespace wrlkit::simplify

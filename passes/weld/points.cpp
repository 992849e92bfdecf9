// A point joins the first one within the tolerance, which must not itself have joined another: otherwise a chain of
// points would drift together from end to end. Those that replace others lie in a grid whose cells are four
// tolerances wide, so that a cell holds few of them and the ball around a point meets three cells on average. Equal
// points, which are most of a soup, are found before that by their hash.
#include "passes/weld/points.h"

#include <algorithm>
#include <limits>

namespace wrlkit {
namespace {

constexpr double cell_size = 4;  // in tolerances

double square(double v) { return v * v; }

std::array<double, 3> cell_of(const double* p, double size) {
  return {std::floor(p[0] / size), std::floor(p[1] / size), std::floor(p[2] / size)};
}

}  // namespace

void PointJoiner::join_equal(std::span<const double> positions, std::vector<std::uint32_t>& index, StampedMap& map) {
  equal_.start(std::min(index.size(), positions.size() / 3));
  position.clear();
  n_joined = 0;
  map.reset(positions.size() / 3);
  for (std::uint32_t& i : index) {
    if (!map.contains(i)) {
      std::uint32_t n = equal_.number(positions.data() + std::size_t{3} * i);
      map.set(i, n);
      n == position.size() ? position.push_back(i) : void(++n_joined);
    }
    i = map[i];
  }
  points.swap(equal_.values);
}

void PointJoiner::join_near(double tolerance, std::vector<std::uint32_t>& index) {
  grid_.start(position.size());
  number_.clear();
  std::uint32_t n_left = 0;
  for (std::uint32_t n = 0; n < position.size(); ++n) {
    double* p = &points[std::size_t{3} * n];
    number_.push_back(first_within(tolerance, p));
    if (number_[n] != CellGrid::none) continue;
    grid_.add(cell_of(p, cell_size * tolerance), n_left);
    std::copy(p, p + 3, &points[std::size_t{3} * n_left]);
    position[n_left] = position[n];
    number_[n] = n_left++;
  }
  n_joined += position.size() - n_left;
  position.resize(n_left);
  points.resize(std::size_t{3} * n_left);
  for (std::uint32_t& i : index) i = number_[i];
}

void PointJoiner::drop_unused(std::vector<std::uint32_t>& index) {
  number_.assign(points.size() / 3, CellGrid::none);
  equal_.values.clear();
  for (std::uint32_t& i : index) {
    if (number_[i] == CellGrid::none) {
      number_[i] = static_cast<std::uint32_t>(equal_.values.size() / 3);
      equal_.values.insert(equal_.values.end(), &points[std::size_t{3} * i], &points[std::size_t{3} * i] + 3);
    }
    i = number_[i];
  }
  points.swap(equal_.values);
}

/// The first of the points that are left so far.
std::uint32_t PointJoiner::first_within(double tolerance, const double* p) const {
  std::uint32_t first = CellGrid::none;
  std::array<double, 3> low, high;
  for (int i = 0; i < 3; ++i) {
    low[i] = p[i] - tolerance;
    high[i] = p[i] + tolerance;
  }
  for_each_cell(low, high, cell_size * tolerance, [&](const std::array<double, 3>& cell) {
    grid_.visit(cell, [&](std::uint32_t n) {
      const double* q = &points[std::size_t{3} * n];
      double d = square(p[0] - q[0]) + square(p[1] - q[1]) + square(p[2] - q[2]);
      if (d <= square(tolerance)) first = std::min(first, n);
    });
  });
  return first;
}

// -- tolerance_by_digits

namespace {

constexpr int most_decimals = 15;
constexpr double steps_across = 1000;      // of a shape in which one step is no more than noise
constexpr double farthest_in_steps = 1.8;  // of two points that each coordinate has one step apart: the root of 3

/// How many decimals a number was printed with, at least `n`: the fewest that give the same double again.
int decimals(double v, int n) {
  static constexpr double power[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                     1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  while (n < most_decimals && std::nearbyint(v * power[n]) / power[n] != v) ++n;
  return n;
}

}  // namespace

/// Numbers are printed with as many decimals, or as many digits, each. Either way the largest have the coarsest step,
/// and they alone are looked at: those within a factor of ten.
double tolerance_by_digits(std::span<const double> points) {
  constexpr double huge = std::numeric_limits<double>::max();
  double low[3] = {huge, huge, huge}, high[3] = {-huge, -huge, -huge}, largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], points[i]);
    high[i % 3] = std::max(high[i % 3], points[i]);
    largest = std::max(largest, std::abs(points[i]));
  }
  int n = 0;
  for (double v : points)
    if (std::abs(v) >= largest / 10) n = decimals(v, n);
  double size = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  double step = std::max(std::pow(10, -n), size * std::numeric_limits<float>::epsilon());
  return step * steps_across <= size ? farthest_in_steps * step : 0;
}

}  // namespace wrlkit

// Axis-parallel boxes.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "base/math/vec.h"

namespace wrlkit {

/// Empty until something is added; what is not a number adds nothing.
template <class T, std::size_t N>
struct BoxOf {
  using Point = std::array<T, N>;
  static constexpr T inf = std::numeric_limits<T>::infinity();

  Point low = filled(inf);
  Point high = filled(-inf);

  bool empty() const { return !(low[0] <= high[0]); }
  void add(const T* p) {
    for (std::size_t i = 0; i < N; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  void add(const Point& p) { add(p.data()); }
  void unite(const BoxOf& b) {
    for (std::size_t i = 0; i < N; ++i) {
      low[i] = std::min(low[i], b.low[i]);
      high[i] = std::max(high[i], b.high[i]);
    }
  }
  T size(std::size_t axis) const { return high[axis] - low[axis]; }
  Point size() const {
    return each([&](std::size_t i) { return high[i] - low[i]; });
  }
  Point centre() const {
    return each([&](std::size_t i) { return T{0.5} * low[i] + T{0.5} * high[i]; });
  }
  /// i from 0: bit k is set where the corner is at the high end of axis k.
  Point corner(int i) const {
    return each([&](std::size_t k) { return (i >> k) & 1 ? high[k] : low[k]; });
  }

 private:
  static constexpr Point filled(T value) {
    Point p{};
    p.fill(value);
    return p;
  }
  template <class F>
  static Point each(F value) {
    Point p{};
    for (std::size_t i = 0; i < N; ++i) p[i] = value(i);
    return p;
  }
};

using Box2 = BoxOf<double, 2>;
using Box = BoxOf<double, 3>;

/// The box of points, N numbers each.
template <std::size_t N, class T>
BoxOf<T, N> box_of(std::span<const T> numbers) {
  BoxOf<T, N> box;
  for (std::size_t i = 0; i + N <= numbers.size(); i += N) box.add(&numbers[i]);
  return box;
}

/// Length of the diagonal; 0 of the empty box.
inline double diagonal(const Box& b) { return b.empty() ? 0 : length(b.size()); }

}  // namespace wrlkit

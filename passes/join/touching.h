// Which of many things have points in common, directly or by way of others: the faces of one surface that a CAD system
// has written one by one.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace wrlkit {

class Touching {
 public:
  /// One thing more, with its points, which are the same only where all digits are. O(points).
  void add(std::span<const double> positions, std::span<const std::uint32_t> corners);
  /// What touches, each in the order in which it was added.
  std::vector<std::vector<std::size_t>> groups();

 private:
  using Point = std::array<double, 3>;
  struct PointHash {
    std::size_t operator()(const Point&) const;
  };
  std::uint32_t first_of(std::uint32_t thing);

  std::unordered_map<Point, std::uint32_t, PointHash> owner_;
  std::vector<std::uint32_t> joined_to_;  // a thing before it, or itself
};

}  // namespace wrlkit

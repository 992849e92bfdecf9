// What a number given as an option of a pass may be: f("depth", depth, "how deep ...", at_least(1)).
#pragma once
#include <limits>

namespace wrlkit {

/// Both ends belong to it. NaN is in no range.
struct OptionRange {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double least = -none, most = none;
  bool is_length = false;  // in metres; 1mm is one, too

  constexpr bool contains(double v) const { return v >= least && v <= most; }
};

constexpr OptionRange at_least(double least) { return {.least = least}; }
constexpr OptionRange a_length() { return {.least = 0, .is_length = true}; }
constexpr OptionRange between(double least, double most) { return {.least = least, .most = most}; }

}  // namespace wrlkit

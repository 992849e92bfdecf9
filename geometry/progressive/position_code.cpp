#include "geometry/progressive/position_code.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace wrlkit::simplify {
namespace {

constexpr std::array<double, 16> powers{1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                        1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

/// The nearest finite float; NaN is 0.
float to_float(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  return std::isnan(x) ? 0 : static_cast<float>(std::clamp(x, -largest, largest));
}

double parsed(const char* begin, const char* end) {
  double x = 0;
  std::from_chars(begin, end, x);
  return x;
}

/// Printed with that many significant digits and read again. Halfway between two, the even one is printed.
double printed_and_read(float f, int digits) {
  char text[40];
  return parsed(text, std::to_chars(text, std::end(text), double{f}, std::chars_format::scientific, digits - 1).ptr);
}

/// The first of printed_and_read for 1, 2, ... digits that is nearest to f of all singles.
double shortest_and_read(float f) {
  char text[40];
  double x = parsed(text, std::to_chars(text, std::end(text), f, std::chars_format::scientific).ptr);
  // Where the singles below f are denser than those above, and where they have few digits, the library takes others.
  const auto bits = std::bit_cast<std::uint32_t>(f);
  if ((bits & 0x7fffff) && (bits & 0x7f800000) && static_cast<float>(x) == f) return x;
  for (int digits = 1; digits <= 9; ++digits)
    if (x = printed_and_read(f, digits); static_cast<float>(x) == f) break;
  return x;
}

}  // namespace

std::int64_t ordered(float f) {
  const auto bits = std::bit_cast<std::uint32_t>(f);
  const auto magnitude = static_cast<std::int64_t>(bits & 0x7fffffffu);
  return bits >> 31 ? -1 - magnitude : magnitude;
}

float from_ordered(std::int64_t n) {
  const auto bits = n < 0 ? static_cast<std::uint32_t>(-1 - n) | 0x80000000u : static_cast<std::uint32_t>(n);
  return std::bit_cast<float>(bits);
}

PositionCode::PositionCode(std::uint8_t kind) : kind_(kind), scale_(kind <= max_digits ? powers[kind] : 1) {}

double PositionCode::whole_of(double x) const {
  return std::isnan(x) ? 0 : std::round(std::clamp(x * scale_, -max_whole, max_whole)) + 0.;
}

double PositionCode::nearest(double x) const {
  if (kind_ == real) return x;
  return kind_ > max_digits ? value_of(to_float(x)) : whole_of(x) / scale_;
}

double PositionCode::value_of(float f) const {
  if (kind_ == shortest) return shortest_and_read(f);
  return kind_ >= printed ? printed_and_read(f, 6 + kind_ - printed) : f;
}

bool PositionCode::holds(double x) const {
  return std::isfinite(x) && std::bit_cast<std::uint64_t>(nearest(x)) == std::bit_cast<std::uint64_t>(x);
}

void PositionCode::write(ByteWriter& out, double x, double predicted) const {
  if (kind_ == real)
    out.fixed(x);
  else if (kind_ > max_digits)
    out.whole(ordered(to_float(x)) - ordered(to_float(predicted)));
  else
    out.whole(static_cast<std::int64_t>(whole_of(x) - whole_of(predicted)));
}

std::optional<double> PositionCode::read(ByteReader& in, double predicted) const {
  if (kind_ == real) {
    const auto x = in.fixed<double>();
    return std::isfinite(x) ? std::optional(x) : std::nullopt;
  }
  const std::int64_t difference = in.whole();
  if (std::abs(static_cast<double>(difference)) > 2 * max_whole) return {};
  if (kind_ > max_digits) {
    const std::int64_t n = ordered(to_float(predicted)) + difference, infinity = 0x7f800000;
    return n < infinity && n >= -infinity ? std::optional(value_of(from_ordered(n))) : std::nullopt;
  }
  const double n = whole_of(predicted) + static_cast<double>(difference);
  return std::abs(n) <= max_whole ? std::optional(n / scale_) : std::nullopt;
}

}  // namespace wrlkit::simplify

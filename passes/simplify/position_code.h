// Coordinates in a stream: whole numbers of a decimal step, single or double precision. Each is written as the difference from
// a prediction that the reader can make as well, and reads back as the same bits.
#pragma once
#include <cstdint>
#include <optional>

#include "passes/simplify/bytes.h"

namespace wrlkit::simplify {

class PositionCode {
 public:
  static constexpr std::uint8_t max_digits = 15, single = 16, real = 17;
  static constexpr double max_whole = 1ll << 44;  // so that differences are exact where all numbers are doubles

  /// 0 to max_digits: whole numbers of that many decimal digits behind the point; or single, or real (double).
  explicit PositionCode(std::uint8_t kind);

  std::uint8_t kind() const { return kind_; }
  /// The nearest value that can be said.
  double nearest(double x) const;
  /// Whether that is x, bit for bit.
  bool holds(double x) const;
  void write(ByteWriter& out, double x, double predicted) const;
  /// Nothing when it is no finite number, or too large a whole one.
  std::optional<double> read(ByteReader& in, double predicted) const;

 private:
  double whole_of(double x) const;
  std::uint8_t kind_;
  double scale_;
};

/// Single precision as whole numbers in the order of the values: floats that are close have numbers that are.
std::int64_t ordered(float f);
float from_ordered(std::int64_t n);

}  // namespace wrlkit::simplify

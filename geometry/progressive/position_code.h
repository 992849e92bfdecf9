// Coordinates in a stream: whole numbers of a decimal step, single precision (exactly, or as it was printed with so
// many digits and read again as double), or double precision. Each is written as the difference from a prediction that
// the reader can make as well, and reads back as the same bits.
#pragma once
#include <cstdint>
#include <optional>

#include "geometry/progressive/bytes.h"

namespace wrlkit::simplify {

class PositionCode {
 public:
  static constexpr std::uint8_t max_digits = 15, single = 16, real = 17, printed = 18, shortest = 22;
  static constexpr double max_whole = 1ll << 44;  // so that differences are exact where all numbers are doubles

  /// 0 to max_digits: whole numbers of that many decimal digits behind the point; single; real (double); from
  /// `printed` on the double that is read when a single is printed with 6, 7, 8 or 9 digits, or with as few as tell it
  /// apart.
  explicit PositionCode(std::uint8_t kind);

  std::uint8_t kind() const { return kind_; }
  /// The nearest value that can be expressed.
  double nearest(double x) const;
  /// Whether that is x, bit for bit.
  bool holds(double x) const;
  void write(ByteWriter& out, double x, double predicted) const;
  /// Nothing when it is not a finite number, or too large a whole one.
  std::optional<double> read(ByteReader& in, double predicted) const;

 private:
  double whole_of(double x) const;
  double value_of(float f) const;
  std::uint8_t kind_;
  double scale_;
};

/// Single precision as whole numbers in the order of the values: floats that are close have numbers that are.
std::int64_t ordered(float f);
float from_ordered(std::int64_t n);

}  // namespace wrlkit::simplify

// The texels that a piece touches, as bits and as runs of bits.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/unwrap/rows.h"

namespace wrlkit::unwrap {

class Bitmap {
 public:
  /// All zero.
  void reset(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }

  /// Sets the bits from `first` to `last` of a row.
  void set_run(int y, int first, int last);
  /// Sets what the triangle touches; beyond the border is cut off.
  void add(const Triangle2& t);
  /// Sets the other's bits, its origin at (x, y).
  void add(const Bitmap& other, int x, int y);
  /// Calls f(y, first, last) for each run of set bits, row by row.
  template <class F>
  void for_each_run(F&& f) const {
    for (int y = 0; y < height_; ++y)
      for (int x = find(y, 0, true); x < width_;) {
        int end = find(y, x, false);
        f(y, x, end - 1);
        x = find(y, end, true);
      }
  }

 private:
  /// The first x from there on whose bit is so; the width if there is none.
  int find(int y, int x, bool set) const;

  int width_ = 0, height_ = 0, stride_ = 0;
  std::vector<std::uint64_t> words_;
};

/// Turned by a quarter, counter-clockwise when y goes up.
void turn_quarter(const Bitmap& from, Bitmap& to);

/// A bitmap's runs, those first that are most likely to be in the way.
struct Mask {
  struct Run {
    int y, first, last;
  };
  int width = 0, height = 0;
  std::vector<Run> runs;
  std::vector<int> longest;  // of each row, the texels of its longest run

  void make(const Bitmap& bitmap);
};

}  // namespace wrlkit::unwrap

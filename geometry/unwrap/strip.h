// A strip of texels, as wide as a page and as long as it takes, in which masks find room. Pages are pieces of the
// strip.
//
// For each row and each k there is a line of bits that says at which x one of the 2^k texels from there on is taken. So
// a run of any length is asked with two shifted words for 64 places at a time, and a whole line of places is given up
// as soon as all its bits are set.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/unwrap/mask.h"

namespace wrlkit::unwrap {

struct Spot {
  int x = 0, y = 0;
};

class Strip {
 public:
  /// `page_height`: no mask crosses its multiples; 0: there are none.
  Strip(int width, int page_height, int padding);

  /// The first place, from `y` on and up to `last_y`, in which the mask is clear of all others; the lowest, then the
  /// leftmost.
  std::optional<Spot> find(const Mask& mask, int y, int last_y);
  void put(const Mask& mask, Spot at);

  int width() const { return width_; }
  /// Rows in use.
  int top() const { return top_; }

 private:
  std::uint64_t* line(int y, int level) { return &lines_[(std::size_t(y) * levels_ + level) * stride_]; }
  void grow(int rows);
  bool block(const Mask::Run& run, int y);
  int longest_gap(int y);
  int hopeless(const Mask& mask, int y) const;
  void smear(int y, int first, int last);

  int width_, page_height_, padding_, levels_, stride_, rows_ = 0, top_ = 0;
  std::vector<std::uint64_t> lines_;
  std::vector<int> gaps_;  // of each row, the longest that is free
  std::vector<std::uint64_t> blocked_;
  int low_ = 0, high_ = 0;  // words of blocked_ that are not all ones, and those between
};

}  // namespace wrlkit::unwrap

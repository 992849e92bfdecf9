#include "geometry/unwrap/mask.h"

#include <bit>

namespace wrlkit::unwrap {

void Bitmap::reset(int width, int height) {
  width_ = width;
  height_ = height;
  stride_ = (width + 63) / 64;
  words_.assign(static_cast<std::size_t>(stride_) * height, 0);
}

void Bitmap::set_run(int y, int first, int last) {
  std::uint64_t* row = &words_[static_cast<std::size_t>(y) * stride_];
  int a = first >> 6, b = last >> 6;
  std::uint64_t head = ~std::uint64_t{0} << (first & 63), tail = ~std::uint64_t{0} >> (63 - (last & 63));
  if (a == b) {
    row[a] |= head & tail;
    return;
  }
  row[a] |= head;
  for (int i = a + 1; i < b; ++i) row[i] = ~std::uint64_t{0};
  row[b] |= tail;
}

void Bitmap::add(const Triangle2& t) {
  for_each_touched_row(t, [&](int y, int x0, int x1) {
    if (y < 0 || y >= height_) return;
    x0 = std::max(x0, 0);
    x1 = std::min(x1, width_ - 1);
    if (x0 <= x1) set_run(y, x0, x1);
  });
}

void Bitmap::add(const Bitmap& other, int x, int y) {
  other.for_each_run([&](int row, int first, int last) { set_run(y + row, x + first, x + last); });
}

int Bitmap::find(int y, int x, bool set) const {
  const std::uint64_t* row = &words_[static_cast<std::size_t>(y) * stride_];
  while (x < width_) {
    std::uint64_t w = (set ? row[x >> 6] : ~row[x >> 6]) >> (x & 63);
    if (w) return std::min(width_, x + std::countr_zero(w));
    x = (x | 63) + 1;
  }
  return width_;
}

void turn_quarter(const Bitmap& from, Bitmap& to) {
  to.reset(from.height(), from.width());
  from.for_each_run([&](int y, int first, int last) {
    for (int x = first; x <= last; ++x) to.set_run(x, from.height() - 1 - y, from.height() - 1 - y);
  });
}

/// Rows from all over the height come first: neighbouring ones are blocked by the same pieces.
void Mask::make(const Bitmap& bitmap) {
  width = bitmap.width();
  height = bitmap.height();
  runs.clear();
  longest.assign(height, 0);
  bitmap.for_each_run([&](int y, int first, int last) {
    runs.push_back({y, first, last});
    longest[y] = std::max(longest[y], last - first + 1);
  });
  std::size_t ahead = 0;
  for (std::size_t parts = 2; parts <= 8; parts *= 2)
    for (std::size_t k = 1; k < parts && ahead < runs.size(); k += 2)
      std::swap(runs[ahead++], runs[runs.size() * k / parts]);
}

}  // namespace wrlkit::unwrap

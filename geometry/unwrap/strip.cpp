#include "geometry/unwrap/strip.h"

#include <algorithm>
#include <bit>

namespace wrlkit::unwrap {
namespace {

constexpr std::uint64_t all = ~std::uint64_t{0};

void set_bits(std::uint64_t* l, int first, int last) {
  int a = first >> 6, b = last >> 6;
  for (int i = a; i <= b; ++i)
    l[i] |= (i == a ? all << (first & 63) : all) & (i == b ? all >> (63 - (last & 63)) : all);
}

/// The first bit from x on that is so; `end` if there is none before.
int find_bit(const std::uint64_t* l, int x, int end, bool set) {
  while (x < end) {
    std::uint64_t w = (set ? l[x >> 6] : ~l[x >> 6]) >> (x & 63);
    if (w) return std::min(end, x + std::countr_zero(w));
    x = (x | 63) + 1;
  }
  return end;
}

}  // namespace

Strip::Strip(int width, int page_height, int padding)
    : width_(width),
      page_height_(page_height),
      padding_(padding),
      levels_(std::bit_width(unsigned(width))),
      stride_(width / 64 + 2),
      blocked_(stride_) {}

/// Beyond the right border everything is taken.
void Strip::grow(int rows) {
  if (rows <= rows_) return;
  rows = std::max(rows, rows_ + rows_ / 4);
  lines_.resize(std::size_t(rows) * levels_ * stride_, 0);
  for (; rows_ < rows; ++rows_)
    for (int k = 0; k < levels_; ++k) set_bits(line(rows_, k), std::max(0, width_ - (1 << k) + 1), stride_ * 64 - 1);
  gaps_.resize(rows_, width_);
}

/// Marks where the run, in that row, is in the way. False: it is everywhere.
bool Strip::block(const Mask::Run& run, int y) {
  int length = run.last - run.first + 1, k = std::bit_width(unsigned(length)) - 1;
  const std::uint64_t* l = line(y, k);
  auto add = [&](int shift) {
    const std::uint64_t* from = l + (shift >> 6);
    int s = shift & 63;
    if (s == 0)
      for (int i = low_; i <= high_; ++i) blocked_[i] |= from[i];
    else
      for (int i = low_; i <= high_; ++i) blocked_[i] |= from[i] >> s | from[i + 1] << (64 - s);
  };
  add(run.first);
  if (length != 1 << k) add(run.last + 1 - (1 << k));
  while (low_ <= high_ && blocked_[low_] == all) ++low_;
  while (low_ <= high_ && blocked_[high_] == all) --high_;
  return low_ <= high_;
}

std::optional<Spot> Strip::find(const Mask& mask, int y, int last_y) {
  if (mask.width > width_) return std::nullopt;
  for (; y <= last_y; ++y) {
    if (page_height_ > 0 && y % page_height_ + mask.height > page_height_) {
      if (mask.height > page_height_) return std::nullopt;
      y += page_height_ - y % page_height_ - 1;
      continue;
    }
    grow(y + mask.height);
    if (int n = hopeless(mask, y)) {
      y += n - 1;
      continue;
    }
    low_ = 0;
    high_ = (width_ - mask.width) / 64;
    std::fill(blocked_.begin(), blocked_.begin() + high_ + 1, 0);
    bool open = true;
    for (const Mask::Run& run : mask.runs)
      if (!(open = block(run, y + run.y))) break;
    if (open) return Spot{low_ * 64 + std::countr_one(blocked_[low_]), y};
  }
  return std::nullopt;
}

void Strip::put(const Mask& mask, Spot at) {
  grow(at.y + mask.height + padding_);
  int page = page_height_ > 0 ? at.y / page_height_ : 0;
  int first_row = page * page_height_, last_row = page_height_ > 0 ? first_row + page_height_ - 1 : rows_ - 1;
  for (const Mask::Run& r : mask.runs)
    for (int d = -padding_; d <= padding_; ++d)
      if (int y = at.y + r.y + d; y >= first_row && y <= last_row && y < rows_)
        set_bits(line(y, 0), std::max(0, at.x + r.first - padding_), std::min(width_ - 1, at.x + r.last + padding_));
  for (int y = std::max(first_row, at.y - padding_); y < std::min(last_row + 1, at.y + mask.height + padding_); ++y) {
    smear(y, std::max(0, at.x - padding_), std::min(width_ - 1, at.x + mask.width + padding_));
    gaps_[y] = longest_gap(y);
  }
  top_ = std::max(top_, at.y + mask.height);
}

/// The longest row of texels that are free.
int Strip::longest_gap(int y) {
  const std::uint64_t* l = line(y, 0);
  int longest = 0;
  for (int x = find_bit(l, 0, width_, false); x < width_;) {
    int end = find_bit(l, x, width_, true);
    longest = std::max(longest, end - x);
    x = find_bit(l, end, width_, false);
  }
  return longest;
}

/// How many lines of places from y on are taken because the mask has a longer run than there is room for.
int Strip::hopeless(const Mask& mask, int y) const {
  for (int r = mask.height - 1; r >= 0; --r) {
    int gap = gaps_[y + r], n = 0;
    while (r - n >= 0 && mask.longest[r - n] > gap) ++n;
    if (n > 0) return n;
  }
  return 0;
}

/// Brings the higher levels of a row up to date.
void Strip::smear(int y, int first, int last) {
  for (int k = 0; k + 1 < levels_; ++k) {
    const std::uint64_t* from = line(y, k);
    std::uint64_t* to = line(y, k + 1);
    int step = 1 << k, w = step >> 6, s = step & 63;
    int a = std::max(0, first - 2 * step) >> 6, b = last >> 6;
    for (int i = a; i <= b; ++i) {
      std::uint64_t next = i + w + 1 < stride_ ? from[i + w + 1] : all;
      std::uint64_t here = i + w < stride_ ? from[i + w] : all;
      to[i] = from[i] | (s ? here >> s | next << (64 - s) : here);
    }
  }
}

}  // namespace wrlkit::unwrap

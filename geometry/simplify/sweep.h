// The order in which edges of a large mesh go. Of a cost only the exponent counts: edges between two powers of two, or
// of four, are equal. Those up to a limit are taken in one sweep over the vertices as they lie in memory; then the
// limit rises to the lowest cost that was seen above it. So there is nothing to keep sorted, and a sweep does much on
// its way through the memory.
//
// To pass a vertex costs about a nanosecond, and there are no more sweeps than exponents that occur, 2,048 at the most;
// among edges of infinite cost, some more.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/simplify/queue.h"

namespace wrlkit::simplify {

class SweepQueue final : public VertexQueue {
 public:
  /// `octaves`: 1 or 2, how many powers of two are one. Two are faster and less exact (rationale.md).
  SweepQueue(std::size_t n_vertices, int octaves)
      : VertexQueue(51 + octaves),
        far_(octaves == 1 ? 2 : 1),
        infinite_(octaves == 1 ? 0x7ff : 0x3ff),
        key_(n_vertices, absent) {}

  bool empty() override { return size_ == 0; }
  /// Whatever has become cheaper behind the sweep waits for the next.
  std::uint32_t top() override {
    while (key_[at_] > limit_) {
      for (; at_ < key_.size() && key_[at_] > limit_; ++at_) next_ = std::min(next_, key_[at_]);
      if (at_ == key_.size()) {
        at_ = 0;
        limit_ = std::min<Short>(std::max<Short>(next_, limit_ + 1), last);
        next_ = absent;
      }
    }
    return at_;
  }
  Key top_key() override { return limit_; }
  bool contains(std::uint32_t v) const override { return key_[v] != absent; }

  void set(std::uint32_t v, Key key) override {
    size_ += key_[v] == absent;
    key_[v] = static_cast<Short>(key);
    if (v <= at_) next_ = std::min(next_, key_[v]);
  }
  void remove(std::uint32_t v) override {
    size_ -= key_[v] != absent;
    key_[v] = absent;
  }
  bool put_off(std::uint32_t v) override {
    set(v, std::min(limit_ + far_, infinite_));
    return true;
  }

 private:
  using Short = std::uint16_t;
  static constexpr Short absent = 0xffff;
  static constexpr Short last = absent - 1;
  const Key far_, infinite_;  // four times the cost; the key of an infinite one

  std::vector<Short> key_;
  std::size_t size_ = 0;
  std::uint32_t at_ = 0;
  Short limit_ = 0, next_ = absent;  // the lowest key above the limit, of those that the sweep has passed
};

}  // namespace wrlkit::simplify

// The order in which edges of a large mesh go. Costs have one bit of the mantissa: edges within a half of each other
// count as equal. Those up to a limit are taken in one sweep over the vertices as they lie in memory; then the limit
// rises to the lowest cost that was seen above it. There is nothing to keep sorted, and the next vertices are known.
//
// A sweep costs a fraction of a nanosecond a vertex, and there are at most 4,096: as many as there are keys.
#pragma once
#include <algorithm>

#include "passes/simplify/queue.h"

namespace wrlkit::simplify {

class SweepQueue final : public VertexQueue {
 public:
  explicit SweepQueue(std::size_t n_vertices) : VertexQueue(51), key_(n_vertices, absent) {}

  bool empty() override { return size_ == 0; }
  std::uint32_t top() override {
    while (key_[at_] > limit_) {
      for (; at_ < key_.size() && key_[at_] > limit_; ++at_) next_ = std::min(next_, key_[at_]);
      if (at_ == key_.size()) at_ = 0, limit_ = std::max<Short>(next_, limit_ + 1), next_ = absent;
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
  bool put_off(std::uint32_t v) override { return set(v, limit_ + far), true; }

 private:
  using Short = std::uint16_t;
  static constexpr Short absent = 0xffff;
  static constexpr Key far = 4;  // four times the cost

  std::vector<Short> key_;
  std::size_t size_ = 0;
  std::uint32_t at_ = 0;
  Short limit_ = 0, next_ = absent;  // the lowest key above the limit, of those that the sweep has passed
};

}  // namespace wrlkit::simplify

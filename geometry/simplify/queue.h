// The order in which edges go: vertices, each with the cost of its cheapest edge. For a small mesh that order is exact
// (HeapQueue), for a large one it is near (sweep.h).
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

namespace wrlkit::simplify {

class VertexQueue {
 public:
  /// The upper half of the bits of a cost, or fewer; costs with equal keys are not told apart.
  using Key = std::uint32_t;

  virtual ~VertexQueue() = default;
  Key key(double cost) const { return static_cast<Key>(std::bit_cast<std::uint64_t>(cost + 0.0) >> shift_); }

  virtual bool empty() = 0;
  /// The vertex whose turn it is, until it is removed or gets a key above top_key().
  virtual std::uint32_t top() = 0;
  virtual Key top_key() = 0;
  virtual bool contains(std::uint32_t v) const = 0;
  /// Adds the vertex or changes its key.
  virtual void set(std::uint32_t v, Key key) = 0;
  virtual void remove(std::uint32_t v) = 0;
  /// Adds a vertex that was not priced, to come up when costs have risen much. False: this queue does no such thing.
  virtual bool put_off(std::uint32_t) { return false; }

 protected:
  explicit VertexQueue(int shift) : shift_(shift) {}

 private:
  int shift_;
};

/// A heap. Keys have 20 bits of the mantissa and the whole range of a double; equal ones go by the number of the
/// vertex. So an entry is eight bytes and the order does not depend on how it came about.
class HeapQueue final : public VertexQueue {
 public:
  explicit HeapQueue(std::size_t n_vertices) : VertexQueue(32), at_(n_vertices, absent) {}

  bool empty() override { return heap_.empty(); }
  std::uint32_t top() override { return vertex(heap_[0]); }
  Key top_key() override { return static_cast<Key>(heap_[0] >> 32); }
  bool contains(std::uint32_t v) const override { return at_[v] != absent; }

  void set(std::uint32_t v, Key key) override {
    std::uint64_t entry = std::uint64_t{key} << 32 | v;
    std::uint32_t i = at_[v];
    if (i == absent) {
      i = static_cast<std::uint32_t>(heap_.size());
      heap_.push_back(entry);
    }
    place(i, entry);
  }
  void remove(std::uint32_t v) override {
    std::uint32_t i = at_[v];
    if (i == absent) return;
    at_[v] = absent;
    std::uint64_t last = heap_.back();
    heap_.pop_back();
    if (i < heap_.size()) place(i, last);
  }

 private:
  static constexpr std::uint32_t absent = 0xffffffffu;
  static std::uint32_t vertex(std::uint64_t entry) { return static_cast<std::uint32_t>(entry); }

  void put(std::size_t i, std::uint64_t entry) {
    heap_[i] = entry;
    at_[vertex(entry)] = static_cast<std::uint32_t>(i);
  }

  /// Puts the entry where it belongs, from the hole at i.
  void place(std::size_t i, std::uint64_t entry) {
    while (i > 0 && entry < heap_[(i - 1) / 4]) {
      put(i, heap_[(i - 1) / 4]);
      i = (i - 1) / 4;
    }
    while (true) {
      std::size_t c = 4 * i + 1, end = c + 4 < heap_.size() ? c + 4 : heap_.size();
      if (c >= end) break;
      for (std::size_t d = c + 1; d < end; ++d)
        if (heap_[d] < heap_[c]) c = d;
      if (entry <= heap_[c]) break;
      put(i, heap_[c]);
      i = c;
    }
    put(i, entry);
  }

  std::vector<std::uint64_t> heap_;  // 4-ary
  std::vector<std::uint32_t> at_;
};

}  // namespace wrlkit::simplify

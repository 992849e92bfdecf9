// Numbers for values: equal ones get the same, new ones the next. An open hash table of numbers next to the values
// themselves; it grows with what is in it and not with what is looked up, so that the table of a soup of faces, each
// point of which comes five times, stays small.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

namespace wrlkit {

/// Good mixing: coordinates differ in few bits, often in the highest of the mantissa only.
inline std::uint64_t mix(std::uint64_t h) {
  h = (h ^ h >> 32) * 0xd6e8feb86659fd93u;
  return h ^ h >> 29;
}

inline std::uint64_t bits_of(double v) { return std::bit_cast<std::uint64_t>(v + 0.0); }  // + 0: -0 is 0
inline std::uint64_t bits_of(float v) { return std::bit_cast<std::uint32_t>(v + 0.f); }

template <class T, int width>
class ValueTable {
 public:
  void start(std::size_t n_expected) {
    values.clear();
    slots_.assign(std::bit_ceil(n_expected / 2 + 8), none);
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(values.size() / width); }

  /// Number of a value; count() grows when it is new. Not for NaN, which equals nothing.
  std::uint32_t number(const T* v) {
    if (2 * std::size_t{count()} >= slots_.size()) grow();
    for (std::size_t i = hash(v);; ++i) {
      std::uint32_t& slot = slots_[i & (slots_.size() - 1)];
      if (slot == none) {
        slot = count();
        values.insert(values.end(), v, v + width);
        return slot;
      }
      if (equal(&values[std::size_t{slot} * width], v)) return slot;
    }
  }

  std::vector<T> values;

 private:
  static constexpr std::uint32_t none = 0xffffffffu;

  static bool equal(const T* a, const T* b) {
    bool same = true;
    for (int i = 0; i < width; ++i) same &= a[i] == b[i];
    return same;
  }
  static std::size_t hash(const T* v) {
    std::uint64_t h = 0;
    for (int i = 0; i < width; ++i) h = std::rotl(h, 23) * 0x9e3779b97f4a7c15u ^ bits_of(v[i]);
    return mix(mix(h));
  }
  void grow() {
    slots_.assign(2 * slots_.size(), none);
    for (std::uint32_t n = 0; n < count(); ++n) {
      std::size_t i = hash(&values[std::size_t{n} * width]);
      while (slots_[i & (slots_.size() - 1)] != none) ++i;
      slots_[i & (slots_.size() - 1)] = n;
    }
  }

  std::vector<std::uint32_t> slots_;  // a power of two
};

}  // namespace wrlkit

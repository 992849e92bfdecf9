// Random numbers by counting: each is a hash of what it is for (seed, point, sample, dimension), so that no thread
// waits for another and any order of work gives the same picture.
//
// The hash is three rounds of shift and multiplication, which spread each bit over all 64; a RandomStream hashes a key
// plus multiples of an odd constant (2^64 over the golden ratio). Within a point the first choices come from lattices
// of low discrepancy, the additive recurrence over the powers of the root of x^(d+1) = x + 1 (Roberts' R2, R3 and R4),
// shifted at random for each point: n samples then err like n^-0.75 or better where independent ones err like n^-0.5.
// What is chosen together is one lattice: two of the same number of dimensions take the same steps, so that the second
// would only follow the first.
#pragma once
#include <array>
#include <cstdint>

namespace wrlkit {

inline std::uint64_t random_bits(std::uint64_t x) {
  for (int round = 0; round < 3; ++round) x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93u;
  return x ^ (x >> 32);
}
inline std::uint64_t random_key(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0) {
  return random_bits(random_bits(random_bits(seed) + a) + b);
}
/// In [0, 1).
inline double random_fraction(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// Independent numbers, one after the other.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t key) : at_(key) {}
  std::uint64_t bits() { return random_bits(at_ += 0x9e3779b97f4a7c15u); }
  double next() { return random_fraction(bits()); }

 private:
  std::uint64_t at_;
};

/// Points that fill the unit square, cube or hypercube evenly, whatever their number.
template <int D>
class Lattice {
 public:
  explicit Lattice(std::uint64_t key) {
    RandomStream s(key);
    for (auto& v : shift_) v = static_cast<std::uint32_t>(s.bits() >> 32);
  }
  std::array<double, D> operator[](std::uint32_t i) const {
    static_assert(D >= 2 && D <= 4);
    constexpr std::uint32_t steps[][4] = {{3242174889u, 2447445414u},
                                          {3518319155u, 2882110345u, 2360945575u},
                                          {3679390609u, 3152041523u, 2700274806u, 2313257605u}};
    std::array<double, D> out;
    for (int d = 0; d < D; ++d) out[d] = (shift_[d] + i * steps[D - 2][d]) * 0x1p-32;
    return out;
  }

 private:
  std::array<std::uint32_t, D> shift_;
};

}  // namespace wrlkit

// Counts that stop at the largest number instead of overflowing: a node may be shown 2^100 times.
#pragma once
#include <cstdint>

namespace wrlkit {

constexpr std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) { return a > ~b ? ~0ull : a + b; }
constexpr std::uint64_t saturating_multiply(std::uint64_t a, std::uint64_t b) {
  return b && a > ~0ull / b ? ~0ull : a * b;
}

}  // namespace wrlkit

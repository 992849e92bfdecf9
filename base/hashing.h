// Hashes of what is compared afterwards.
#pragma once
#include <cstdint>

namespace wrlkit {

/// One value more, in its order.
inline std::uint64_t mixed(std::uint64_t h, std::uint64_t v) {
  h = (h ^ v) * 0x9e3779b97f4a7c15u;
  return h ^ (h >> 29);
}

}  // namespace wrlkit

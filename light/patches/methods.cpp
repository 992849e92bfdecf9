#include "light/patches/methods.h"

#include <algorithm>

#include "base/parallel.h"

namespace wrlkit::light {

std::vector<V3> illuminate(const PatchedWorld& world, Method method, const MethodOptions& options) {
  switch (method) {
    case Method::path:
      return follow_paths(world, options);
    case Method::stochastic_iteration:
      return iterate_stochastically(world, options);
    case Method::progressive_radiosity:
      return shoot_progressively(world, options);
  }
  return {};
}

void for_sides(std::uint32_t begin, std::uint32_t end, const std::function<void(std::uint32_t)>& f) {
  constexpr std::uint32_t block = 64;
  parallel_for((end - begin + block - 1) / block, [&](std::size_t b) {
    const auto first = begin + static_cast<std::uint32_t>(b) * block;
    for (auto s = first; s < std::min(end, first + block); ++s) f(s);
  });
}

}  // namespace wrlkit::light

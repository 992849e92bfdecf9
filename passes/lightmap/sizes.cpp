#include "passes/lightmap/sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace wrlkit::bake {
namespace {

using drawing::Affine;

/// The lengths of the axes of a frame and the angles between them, in steps: what neither turning nor mirroring
/// changes. All that is flattened is one step.
using Size = std::array<long, 6>;

Size size_of(const Affine& frame) {
  constexpr double step = 1.15, flat = -1e4;  // a length to the next one
  constexpr double straight = 0.1;            // cosine
  const drawing::V3 axes[] = {frame.x, frame.y, frame.z};
  Size out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = length(axes[k]), b = length(axes[(k + 1) % 3]);
    out[k] = std::lround(a > 0 ? std::log(a) / std::log(step) : flat);
    out[3 + k] = std::lround(a > 0 && b > 0 ? dot(axes[k], axes[(k + 1) % 3]) / (a * b) / straight : 0);
  }
  return out;
}

}  // namespace

void split_by_size(std::vector<Part>& parts, const drawing::Stage& stage,
                   const std::function<double(std::uint32_t use)>& density) {
  std::vector<Part> out;
  for (Part& p : parts) {
    std::map<std::pair<double, Size>, std::size_t> known;
    std::vector<std::vector<std::uint32_t>> groups;
    for (std::uint32_t u : p.uses) {
      const auto [at, is_new] =
          known.try_emplace({density(u), size_of(stage.frames[stage.uses[u].frame])}, groups.size());
      if (is_new) groups.emplace_back();
      groups[at->second].push_back(u);
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      // NOLINTNEXTLINE(bugprone-use-after-move): only the last one is moved
      Part& one = out.emplace_back(g + 1 < groups.size() ? p : std::move(p));
      one.uses = std::move(groups[g]);
      one.density = density(one.uses[0]);
    }
  }
  parts = std::move(out);
}

}  // namespace wrlkit::bake

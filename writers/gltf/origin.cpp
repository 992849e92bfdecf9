#include "writers/gltf/origin.h"

namespace wrlkit::gltf {
namespace {

constexpr double rounding = 1.0 / (1 << 24), largest_loss = 1e-3, largest_relative_loss = 1e-4;

bool loses_millimetres(const Box& b) { return reach(b) * rounding > largest_loss && reach(b) > 10 * diagonal(b); }

Vec3 round_centre(const Box& b) {
  // Steps of about the extent; of a millionth of the distance when there is none.
  double step = std::exp2(std::floor(std::log2(std::max(diagonal(b), reach(b) * 1e-6))));
  Vec3 c = b.centre();
  for (double& x : c) x = std::round(x / step) * step;
  return c;
}

}  // namespace

std::optional<Vec3> mesh_origin(const Box& b) {
  if (b.empty() || !std::isfinite(diagonal(b)) || reach(b) == 0) return std::nullopt;
  bool blurred = reach(b) * rounding > largest_relative_loss * diagonal(b) && diagonal(b) > 0;
  if (!blurred && !loses_millimetres(b)) return std::nullopt;
  return round_centre(b);
}

std::optional<Vec3> world_origin(const Box& b) {
  if (b.empty() || !std::isfinite(diagonal(b)) || !loses_millimetres(b)) return std::nullopt;
  return round_centre(b);
}

}  // namespace wrlkit::gltf

#include "passes/lower_vrml1/strokes.h"

#include <algorithm>
#include <bit>
#include <vector>

#include "scenegraph/nodes.h"

namespace wrlkit::vrml1 {
namespace {

namespace d = nodes::vrml1::draw_style;

constexpr std::int32_t unbroken = 0xffff;

/// The linetype of X3D that is most like a pattern of sixteen bits: by its strokes, and the shortest of them.
int linetype_of(std::int32_t pattern) {
  enum : int { solid = 1, dashed = 2, dotted = 3, dash_dot = 4, dash_dot_dot = 5 };
  constexpr int n_bits = 16, longest_dot = 2;
  const auto bits = static_cast<std::uint16_t>(pattern);
  if (bits == unbroken || bits == 0) return solid;
  const int first = std::countr_one(std::rotr(bits, std::countr_one(bits)));  // the pattern comes again and again
  std::vector<int> strokes;
  for (auto rest = std::rotr(bits, std::countr_one(bits) + first); rest != 0;) {
    rest = static_cast<std::uint16_t>(rest >> std::countr_zero(rest));
    strokes.push_back(std::countr_one(rest));
    rest = strokes.back() == n_bits ? 0 : static_cast<std::uint16_t>(rest >> strokes.back());
  }
  const auto is_dot = [](int n) { return n <= longest_dot; };
  const auto n_dots = std::ranges::count_if(strokes, is_dot);
  if (n_dots == std::ssize(strokes)) return dotted;
  return n_dots == 0 ? dashed : n_dots == 1 ? dash_dot : dash_dot_dot;
}

}  // namespace

bool says_strokes(const Scene& scene, NodeId draw_style) {
  return scene.get(draw_style, d::lineWidth) > 1 || scene.get(draw_style, d::pointSize) > 1 ||
         linetype_of(scene.get(draw_style, d::linePattern)) != 1;
}

void set_strokes(Scene& scene, NodeId appearance, NodeId draw_style) {
  namespace l = nodes::line_properties;
  namespace p = nodes::point_properties;
  const double width = scene.get(draw_style, d::lineWidth), size = scene.get(draw_style, d::pointSize);
  const int type = linetype_of(scene.get(draw_style, d::linePattern));
  if (width > 1 || type != 1) {
    const NodeId lines = scene.add(nodes::LineProperties, scene.where(draw_style));
    if (width > 1) scene.set(lines, l::linewidthScaleFactor, width);
    if (type != 1) scene.set(lines, l::linetype, type);
    scene.set(appearance, nodes::appearance::lineProperties, lines);
  }
  if (size > 1) {
    const NodeId points = scene.add(nodes::PointProperties, scene.where(draw_style));
    scene.set(points, p::pointSizeScaleFactor, size, p::pointSizeMaxValue, size);
    scene.set(appearance, nodes::appearance::pointProperties, points);
  }
}

}  // namespace wrlkit::vrml1

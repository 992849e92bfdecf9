#include "passes/lightmap/finest_light.h"

#include <array>
#include <cmath>
#include <utility>

#include "geometry/simplify/closest_on_triangle.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {
namespace {

using drawing::V3;

Vec3 vec3_of(const V3& v) { return {v.x, v.y, v.z}; }

/// Of six: the axis that it faces along most nearly.
std::uint32_t side_of(const V3& normal) {
  const double c[] = {normal.x, normal.y, normal.z};
  std::uint32_t axis = 0;
  for (std::uint32_t k = 1; k < 3; ++k)
    if (std::fabs(c[k]) > std::fabs(c[axis])) axis = k;
  return 2 * axis + (c[axis] < 0);
}

/// Sides that something which faces so may look alike with.
std::array<char, 6> sides_like(const V3& normal) {
  constexpr double away = 0.1;
  const double c[] = {normal.x, normal.y, normal.z};
  std::array<char, 6> out{};
  for (std::size_t side = 0; side < out.size(); ++side) out[side] = (side % 2 ? -c[side / 2] : c[side / 2]) > away;
  return out;
}

Rgb bilinear(const Canvas& page, double x, double y) {
  const double u = std::clamp(x - 0.5, 0.0, page.width - 1.0), v = std::clamp(y - 0.5, 0.0, page.height - 1.0);
  const auto left = static_cast<int>(u), low = static_cast<int>(v);
  Rgb sum;
  for (int k = 0; k < 4; ++k) {
    const int i = std::min(left + k % 2, page.width - 1), j = std::min(low + k / 2, page.height - 1);
    const double weight = (k % 2 ? u - left : 1 - (u - left)) * (k / 2 ? v - low : 1 - (v - low));
    sum += static_cast<float>(weight) * page.texels[std::size_t(j) * page.width + i];
  }
  return sum;
}

}  // namespace

FinestLight::FinestLight(const Scene& scene) : lod_of_(scene.node_count()) {
  std::vector<std::pair<NodeId, std::uint32_t>> open;
  std::vector<char> met(scene.node_count());
  auto add = [&](NodeId n, std::uint32_t lod) {
    if (!n || std::exchange(met[n.value], 1)) return;
    open.emplace_back(n, lod ? lod : scene.is(n, nodes::LOD) ? n.value + 1 : 0);
  };
  for (NodeId n : scene.main.roots) add(n, 0);
  while (!open.empty()) {
    const auto [n, lod] = open.back();
    open.pop_back();
    lod_of_[n.value] = lod;
    for (NodeId c : hierarchy_children(scene, n)) add(c, lod);
  }
}

void FinestLight::keep(const std::vector<Part>& parts, const Layout& layout, const drawing::Stage& stage,
                       std::vector<BakedPage> pages) {
  const auto first = static_cast<std::uint32_t>(pages_.size());
  for (std::uint32_t i = 0; i < layout.pages().size(); ++i) {
    const PageLayout& page = layout.pages()[i];
    for (std::size_t t = 0; t < page.triangles.size(); ++t) {
      const auto& use = stage.uses[page.refs[t].use];
      if (const auto lod = lod_of_[use.shape.value])
        add(surfaces_[lod], page, first + i, t, parts[page.refs[t].part], stage.frames[use.frame]);
    }
  }
  if (surfaces_.empty()) return;
  for (BakedPage& p : pages) pages_.push_back(std::move(p.light));
  for (auto& [lod, s] : surfaces_)
    s.nearest = std::make_unique<ClosestPoint>(Triangles{s.positions, s.corners}, s.sides);
}

void FinestLight::add(Surface& to, const PageLayout& page, std::uint32_t number, std::size_t triangle, const Part& part,
                      const drawing::Affine& frame) {
  V3 at[3];
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = frame.point(part.position(3 * std::size_t{page.refs[triangle].triangle} + k));
    to.corners.push_back(static_cast<std::uint32_t>(to.corners.size()));
    to.positions.insert(to.positions.end(), {at[k].x, at[k].y, at[k].z});
    to.spots.push_back(page.triangles[triangle].corner[k]);
  }
  const V3 across = frame.determinant() < 0 ? cross(at[2] - at[0], at[1] - at[0]) : cross(at[1] - at[0], at[2] - at[0]);
  to.sides.push_back(side_of(across));
  to.pages.push_back(number);
}

const FinestLight::Surface* FinestLight::surface_of(NodeId shape) const {
  const auto lod = shape.value < lod_of_.size() ? lod_of_[shape.value] : 0;
  const auto at = surfaces_.find(lod);
  return lod && at != surfaces_.end() ? &at->second : nullptr;
}

Rgb FinestLight::light(const Surface& s, std::uint32_t triangle, const V3& place) const {
  const auto found = simplify::closest_on_triangle(vec3_of(place), Triangles{s.positions, s.corners}[triangle]);
  double x = 0, y = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    x += found.at[k] * s.spots[3 * std::size_t{triangle} + k].x;
    y += found.at[k] * s.spots[3 * std::size_t{triangle} + k].y;
  }
  return bilinear(pages_[s.pages[triangle]], x, y);
}

std::optional<Rgb> FinestLight::at(NodeId shape, const V3& place, const V3& normal, double within) const {
  const Surface* s = surface_of(shape);
  if (!s) return {};
  const auto sides = sides_like(normal);
  const auto found = s->nearest->nearest_of(vec3_of(place), within, {.left = sides});
  if (!std::isfinite(found.distance)) return {};
  return light(*s, found.triangle, place);
}

std::optional<Rgb> FinestLight::anywhere(NodeId shape, const V3& place, const V3& normal) const {
  const Surface* s = surface_of(shape);
  if (!s) return {};
  const auto found = s->nearest->nearest(vec3_of(place), vec3_of(normal));
  if (!std::isfinite(found.distance)) return {};
  return light(*s, found.triangle, place);
}

}  // namespace wrlkit::bake

#include "light/render/background.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::drawing {
namespace {

/// The frame with its axes unit and at right angles.
Affine turn_of(const Affine& frame) {
  V3 z = unit(frame.z), x = unit(cross(frame.y, z));
  Affine turn{x, cross(z, x), z, {}};
  return std::fabs(turn.determinant() - 1) < 1e-6 ? turn : Affine{};
}

}  // namespace

Sky::Sky(const Scene& scene, NodeId n, const Affine& frame, Resources* resources, Diagnostics& diag) {
  namespace f = nodes::background;
  to_local_ = turn_of(frame).inverse();
  sky_ = bands(scene.get(n, f::skyColor), scene.get(n, f::skyAngle));
  ground_ = bands(scene.get(n, f::groundColor), scene.get(n, f::groundAngle));
  if (sky_.empty()) sky_.push_back({0, {}});
  // Above and below are as they appear to who looks along -Z and raises or lowers his head.
  auto add = [&](auto key, const V3& out, const V3& right, const V3& up) {
    auto urls = scene.get(n, key);
    if (urls.empty() || !resources) return;
    auto image = resources->image(urls, scene.where(n), diag);
    if (auto picture = image ? Texture::make(*image) : nullptr) faces_.push_back({out, right, up, picture});
  };
  add(f::frontUrl, {0, 0, -1}, {1, 0, 0}, {0, 1, 0});
  add(f::backUrl, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0});
  add(f::leftUrl, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0});
  add(f::rightUrl, {1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  add(f::topUrl, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  add(f::bottomUrl, {0, -1, 0}, {1, 0, 0}, {0, 0, -1});
}

/// The first colour stands at angle 0, each further one at its angle; angles that go back count as those before them.
std::vector<Sky::Band> Sky::bands(std::span<const double> colors, std::span<const double> angles) {
  std::vector<Band> out;
  double angle = 0;
  for (std::size_t i = 0; i < colors.size() / 3 && i <= angles.size(); ++i) {
    if (i > 0) angle = std::max(angle, angles[i - 1]);
    out.push_back({angle, {colors[3 * i], colors[3 * i + 1], colors[3 * i + 2]}});
  }
  return out;
}

V3 Sky::between(const std::vector<Band>& bands, double angle) {
  auto after = std::upper_bound(bands.begin(), bands.end(), angle, [](double a, const Band& b) { return a < b.angle; });
  if (after == bands.begin()) return bands.front().color;
  if (after == bands.end()) return bands.back().color;
  const Band &a = after[-1], &b = after[0];
  return mix(a.color, b.color, (angle - a.angle) / (b.angle - a.angle));
}

V3 Sky::sphere(const V3& d) const {
  double from_top = std::acos(std::clamp(d.y, -1.0, 1.0)), from_bottom = std::acos(-1.0) - from_top;
  bool on_ground = ground_.size() > 1 && from_bottom <= ground_.back().angle;
  return on_ground ? between(ground_, from_bottom) : between(sky_, from_top);
}

V3 Sky::color(const V3& direction, double spread) const {
  if (faces_.empty() && ground_.empty() && sky_.size() == 1) return sky_[0].color;
  V3 d = to_local_.vector(direction);
  V3 out = sphere(d);
  double largest = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
  for (const Face& f : faces_) {
    double along = dot(d, f.out);
    if (along < largest) continue;
    double s = 0.5 * (dot(d, f.right) / along + 1), t = 0.5 * (dot(d, f.up) / along + 1);
    Texel texel = f.picture->sample(s, t, 0.5 * spread / along * f.picture->width(), false, false);
    return mix(out, texel.color, texel.alpha);
  }
  return out;
}

}  // namespace wrlkit::drawing

#include "light/render/background.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::drawing {
namespace {

namespace b = nodes::background;
namespace t = nodes::texture_background;

/// One side of the cube of pictures. Above and below are as they appear to who looks along -Z and raises or lowers his
/// head.
struct Side {
  FieldKey<FieldType::MFString> url;
  FieldKey<FieldType::SFNode> texture;
  V3 out, right, up;
};
const Side sides[] = {
    {b::frontUrl, t::frontTexture, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
    {b::backUrl, t::backTexture, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
    {b::leftUrl, t::leftTexture, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    {b::rightUrl, t::rightTexture, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {b::topUrl, t::topTexture, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {b::bottomUrl, t::bottomTexture, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
};

std::shared_ptr<const Image> image_at(const Scene& scene, NodeId n, std::span<const std::string_view> urls,
                                      Resources* resources, Diagnostics& diag) {
  return urls.empty() || !resources ? nullptr : resources->image(urls, scene.where(n), diag);
}

/// Null for films, and where there is no texture.
std::shared_ptr<const Image> image_of_texture(const Scene& scene, NodeId texture, Resources* resources,
                                              Diagnostics& diag) {
  if (texture && scene.is(texture, nodes::PixelTexture))
    return std::make_shared<const Image>(image_of(scene.get(texture, nodes::pixel_texture::image)));
  if (!texture || !scene.is(texture, nodes::ImageTexture)) return nullptr;
  return image_at(scene, texture, scene.get(texture, nodes::image_texture::url), resources, diag);
}

/// The frame with its axes unit and at right angles.
Affine turn_of(const Affine& frame) {
  V3 z = unit(frame.z), x = unit(cross(frame.y, z));
  Affine turn{x, cross(z, x), z, {}};
  return std::fabs(turn.determinant() - 1) < 1e-6 ? turn : Affine{};
}

}  // namespace

Sky::Sky(const Scene& scene, NodeId n, const Affine& frame, Resources* resources, Diagnostics& diag) {
  to_local_ = turn_of(frame).inverse();
  const bool has_textures = scene.is(n, nodes::TextureBackground);
  if (has_textures)
    set_bands(scene, n, t::skyColor, t::skyAngle, t::groundColor, t::groundAngle);
  else
    set_bands(scene, n, b::skyColor, b::skyAngle, b::groundColor, b::groundAngle);
  for (const Side& side : sides) {
    const auto image = has_textures ? image_of_texture(scene, scene.get(n, side.texture), resources, diag)
                                    : image_at(scene, n, scene.get(n, side.url), resources, diag);
    if (auto picture = image ? Texture::make(*image) : nullptr)
      faces_.push_back({side.out, side.right, side.up, picture});
  }
}

void Sky::set_bands(const Scene& scene, NodeId n, Colors sky, Angles sky_angles, Colors ground, Angles ground_angles) {
  sky_ = bands(scene.get(n, sky), scene.get(n, sky_angles));
  ground_ = bands(scene.get(n, ground), scene.get(n, ground_angles));
  if (sky_.empty()) sky_.push_back({0, {}});
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

constexpr TextureSampler clamped{.s = Wrap::clamp, .t = Wrap::clamp};

V3 Sky::color(const V3& direction, double spread) const {
  if (faces_.empty() && ground_.empty() && sky_.size() == 1) return sky_[0].color;
  V3 d = to_local_.vector(direction);
  V3 out = sphere(d);
  double largest = std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
  for (const Face& f : faces_) {
    double along = dot(d, f.out);
    if (along < largest) continue;
    double s = 0.5 * (dot(d, f.right) / along + 1), t = 0.5 * (dot(d, f.up) / along + 1);
    Texel texel = f.picture->sample(s, t, 0.5 * spread / along * f.picture->width(), clamped);
    return mix(out, texel.color, texel.alpha);
  }
  return out;
}

}  // namespace wrlkit::drawing

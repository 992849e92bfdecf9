#include "convert/look_census.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/image/image.h"
#include "base/image/srgb.h"
#include "base/io/content_hash.h"
#include "base/math/affine.h"
#include "geometry/closest_point.h"
#include "light/render/texture.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"

namespace wrlkit {
namespace {

constexpr int most_apart = 2;                // of 255
constexpr std::size_t most_matched = 2'000;  // looks
constexpr double least_change = 1e-4;        // of the surface

std::uint8_t in_255ths(double v) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0., 1.))); }

std::array<std::uint8_t, 3> in_255ths(const Vec3& v) { return {in_255ths(v[0]), in_255ths(v[1]), in_255ths(v[2])}; }

Vec3 displayed(const Vec3& linear) {
  return {linear_to_srgb(linear[0]), linear_to_srgb(linear[1]), linear_to_srgb(linear[2])};
}

/// Of its pixels with four channels, however many it has.
std::string hash_of_pixels(const Image& image) {
  std::string bytes = fmt::format("{} {} ", image.width, image.height);
  const auto n = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; n > 0 && i + n <= image.pixels.size(); i += n) {
    const auto* p = image.pixels.data() + i;
    const bool is_grey = n < 3;
    for (std::size_t k = 0; k < 3; ++k) bytes += static_cast<char>(is_grey ? p[0] : p[k]);
    bytes += static_cast<char>(n % 2 == 0 ? p[n - 1] : 255);
  }
  return hash_of(bytes).hex();
}

Vec3 mean_color(const Mesh& mesh, std::size_t face) {
  Vec3 sum{};
  for (std::size_t i = 3 * face; i < 3 * face + 3; ++i) {
    const float* c = mesh.color.at(mesh.color.index[i]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k];
  }
  return (1. / 3) * sum;
}

/// Its area in a place.
double area_in(const Mesh& mesh, std::size_t face, const Matrix& place) {
  const Vec3 a = mesh.position(mesh.corners[3 * face]), b = mesh.position(mesh.corners[3 * face + 1]),
             c = mesh.position(mesh.corners[3 * face + 2]);
  return fast_length(cross(direction(place, b - a), direction(place, c - a))) / 2;
}

bool are_alike(const SurfaceLook& a, const SurfaceLook& b) {
  const auto near = [](std::uint8_t x, std::uint8_t y) { return std::abs(x - y) <= most_apart; };
  return a.picture == b.picture && a.is_lit == b.is_lit && near(a.opacity, b.opacity) &&
         near(a.shininess, b.shininess) && std::ranges::equal(a.color, b.color, near) &&
         std::ranges::equal(a.emissive, b.emissive, near) && std::ranges::equal(a.specular, b.specular, near);
}

double sum(const std::map<SurfaceLook, double>& areas) {
  double out = 0;
  for (const auto& [look, area] : areas) out += area;
  return out;
}

/// What there is more of in `a`, by shares, the largest first.
std::vector<LookChange> more_of(const std::map<SurfaceLook, double>& a, const std::map<SurfaceLook, double>& b) {
  const double all = sum(a), other = sum(b);
  std::vector<LookChange> out;
  for (const auto& [look, area] : a) {
    const auto there = b.find(look);
    const double share = area / all - (there == b.end() || !(other > 0) ? 0 : there->second / other);
    if (share > 0) out.push_back({look, share});
  }
  std::ranges::stable_sort(out, std::greater{}, &LookChange::share);
  return out;
}

/// Takes away from both what is nearly the same.
void match(std::vector<LookChange>& gone, std::vector<LookChange>& made) {
  const auto some = [](std::vector<LookChange>& all) {
    return std::span(all).first(std::min(all.size(), most_matched));
  };
  for (auto& a : some(gone))
    for (auto& b : some(made)) {
      if (!(b.share > 0) || !are_alike(a.look, b.look)) continue;
      const double both = std::min(a.share, b.share);
      a.share -= both;
      b.share -= both;
      if (!(a.share > 0)) break;
    }
}

double clean(std::vector<LookChange>& all) {
  double share = 0;
  for (const auto& change : all) share += change.share;
  std::erase_if(all, [](const LookChange& change) { return change.share < least_change; });
  std::ranges::stable_sort(all, std::greater{}, &LookChange::share);
  return share;
}

}  // namespace

std::string text_of(const SurfaceLook& look) {
  const auto hex = [](const auto& c) { return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]); };
  std::string out = hex(look.color);
  if (look.emissive != std::array<std::uint8_t, 3>{}) out += " glowing " + hex(look.emissive);
  if (look.specular != std::array<std::uint8_t, 3>{})
    out += fmt::format(" shining {} ({:.2g})", hex(look.specular), look.shininess / 255.);
  if (look.opacity < 255) out += fmt::format(" transparent {:.0f} %", 100 - look.opacity / 2.55);
  if (!look.is_lit) out += " unlit";
  if (!look.picture.empty()) out += " with picture " + look.picture.substr(0, 8);
  return out;
}

LookCensus::LookCensus(const Scene& scene, Resources* resources, Diagnostics& diag)
    : scene_(scene), resources_(resources), diag_(diag) {
  for_each_place(scene, Shown::now, [&](NodeId shape, const Matrix& place) {
    if (const NodeId geometry = scene.get(shape, nodes::shape::geometry))
      uses_[geometry.value].push_back({scene.get(shape, nodes::shape::appearance), place});
  });
}

std::string LookCensus::picture_of(NodeId texture) {
  if (!texture) return "";
  const auto [at, is_new] = pictures_.try_emplace(texture.value);
  if (!is_new) return at->second;
  std::string out = "none";
  if (scene_.is(texture, nodes::PixelTexture))
    out = hash_of_pixels(drawing::image_of(scene_.get(texture, nodes::pixel_texture::image)));
  else if (scene_.is(texture, nodes::ImageTexture) && resources_)
    if (const auto image =
            resources_->image(scene_.get(texture, nodes::image_texture::url), scene_.where(texture), diag_))
      out = hash_of_pixels(*image);
  return pictures_[texture.value] = out;
}

/// But for colours of vertices.
SurfaceLook LookCensus::look_of(NodeId appearance, const Mesh& mesh) {
  SurfaceLook out;
  const auto material = material_of(scene_, appearance);
  out.is_lit = material && material->kind != MaterialNode::Kind::unlit;
  const bool is_linear = material && material->kind == MaterialNode::Kind::physical;
  out.color = in_255ths(material ? (is_linear ? displayed(material->color) : material->color) : Vec3{1, 1, 1});
  NodeId texture = material ? material->color_picture : NodeId{};
  if (!texture && scene_.is(appearance, nodes::Appearance))
    texture = scene_.get(appearance, nodes::appearance::texture);
  out.picture = picture_of(texture);
  if (!material) return out;
  if (out.is_lit) out.emissive = in_255ths(is_linear ? displayed(material->emissive) : material->emissive);
  out.opacity = in_255ths(1 - material->transparency);
  if (out.is_lit) out.specular = in_255ths(material->specular);
  if (out.specular != std::array<std::uint8_t, 3>{}) out.shininess = in_255ths(material->shininess);
  if (mesh.color.present()) out.color = {};
  // What only glows looks as if it were not lit, which other formats say of it.
  constexpr std::array<std::uint8_t, 3> black{};
  const bool only_glows = !mesh.color.present() && out.picture.empty() && out.color == black && out.specular == black;
  if (only_glows && out.is_lit) {
    out.is_lit = false;
    std::swap(out.color, out.emissive);
  }
  return out;
}

void LookCensus::add(NodeId geometry, const Mesh& mesh) {
  const auto uses = uses_.extract(geometry.value);
  if (!mesh.is_triangles() || uses.empty()) return;
  const std::size_t n = mesh.corners.size() / 3;
  for (const auto& [appearance, place] : uses.mapped()) {
    SurfaceLook look = look_of(appearance, mesh);
    double area = 0;
    for (std::size_t face = 0; face < n; ++face) {
      const double own = area_in(mesh, face, place);
      area += own;
      if (!mesh.color.present() || !(own > 0)) continue;
      look.color = in_255ths(mean_color(mesh, face));
      areas_[look] += own;
    }
    if (!mesh.color.present() && area > 0) areas_[look] += area;
  }
}

LookDifference difference(const std::map<SurfaceLook, double>& a, const std::map<SurfaceLook, double>& b) {
  LookDifference out{0, more_of(a, b), more_of(b, a)};
  match(out.gone, out.made);
  const double gone = clean(out.gone), made = clean(out.made);
  out.share = std::max(gone, made);
  if (out.share < least_change) out = {};
  return out;
}

}  // namespace wrlkit

#include "passes/lightmap/page_baker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "passes/lightmap/cut_off.h"
#include "passes/lightmap/leaks.h"

namespace wrlkit::bake {
namespace {

using drawing::Affine;
using drawing::V3;
using light::Irradiance;
using light::Point;

using std::numbers::pi;
constexpr float within = 0.5f;  // share of rays that meet backs, from which on a point lies inside something

Vec vec(const V3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
Rgb rgb(const light::Rgb& c) { return {c[0], c[1], c[2]}; }

float luminance_of(const Irradiance& p) { return luminance(rgb(p.direct)) + luminance(rgb(p.gathered)); }
bool is_dark(const Irradiance& p) { return !(luminance_of(p) > 0); }

void add(const Irradiance& from, TexelLight& to) {
  to.direct += rgb(from.direct);
  to.gathered += rgb(from.gathered);
  for (int k = 0; k < 3; ++k) to.along[k] += rgb(from.along[k]);
  to.direct_variance += luminance(rgb(from.direct_variance));
  to.gathered_variance += luminance(rgb(from.gathered_variance));
}

/// Leaves those of some texels; the numbers of their samples.
std::vector<std::uint32_t> choose(std::span<const char> chosen, int width, TileTexels& from) {
  std::vector<SurfaceSample> samples;
  std::vector<std::uint32_t> numbers;
  std::erase_if(from.texels, [&](const TexelSamples& t) { return !chosen[std::size_t(t.y) * width + t.x]; });
  for (TexelSamples& t : from.texels) {
    const auto first = from.samples.begin() + t.first;
    for (std::uint32_t k = 0; k < t.count; ++k) numbers.push_back(t.first + k);
    t.first = static_cast<std::uint32_t>(samples.size());
    samples.insert(samples.end(), first, first + t.count);
  }
  from.samples = std::move(samples);
  return numbers;
}

}  // namespace

const std::vector<Point>& PageBaker::points(std::size_t tile, int samples, int side, std::span<const char> chosen) {
  grid_.texels_of(tile, side, samples, texels_);
  numbers_.clear();
  if (!chosen.empty()) numbers_ = choose(chosen, page_.width, texels_);
  points_.clear();
  for (const auto& s : texels_.samples) points_.push_back(point(s));
  return points_;
}

std::vector<TexelLight> PageBaker::gather(std::vector<Irradiance> light) const {
  std::vector<TexelLight> out;
  for (std::size_t i = 0; i < light.size(); ++i)
    if (is_dark(light[i]) && is_enclosed(points_[i])) light[i].inside = 1;
  for (const auto& t : texels_.texels) {
    const std::span all(&light[t.first], t.count);
    TexelLight texel = place(t);
    texel.site = site_of(all, t.first);
    float weight =
        0;  // of a point that lies within something, as far as it sees out; such light counts where there is no other
    for (const Irradiance& l : all) {
      if (texel.site == Site::open && (l.inside > within || is_cut_off(light, t, l))) continue;
      add(l, texel);
      weight += texel.site == Site::open ? 1 : 1 - l.inside;
    }
    const auto scale = weight > 0 ? static_cast<float>(1 / (pi * weight)) : 0;
    texel.direct = scale * texel.direct;
    texel.gathered = scale * texel.gathered;
    for (Rgb& a : texel.along) a = scale * a;
    texel.direct_variance *= scale * scale;
    texel.gathered_variance *= scale * scale;
    out.push_back(texel);
  }
  return out;
}

TexelLight PageBaker::place(const TexelSamples& t) const {
  const Point& middle = points_[t.first + t.count / 2];
  TexelLight out{};
  out.x = t.x;
  out.y = t.y;
  out.chart = page_.triangles[texels_.samples[t.first].triangle].chart;
  out.position = vec(middle.position - world_.centre());
  out.normal = vec(middle.normal);
  return out;
}

/// A point of a texel that lies in the shade beyond a surface which crosses the texel.
bool PageBaker::is_cut_off(std::span<const Irradiance> light, const TexelSamples& t, const Irradiance& own) const {
  const auto all = light.subspan(t.first, t.count);
  const auto brightest =
      std::ranges::max_element(all, {}, [](const Irradiance& p) { return p.inside > within ? -1 : luminance_of(p); });
  const Shade shade = shade_beside(luminance_of(own), luminance_of(*brightest));
  if (shade == Shade::none) return false;
  const Point &from = points_[static_cast<std::size_t>(&*brightest - light.data())],
              &to = points_[static_cast<std::size_t>(&own - light.data())];
  return bake::is_cut_off(world_, shade, from.position, to.position, from.normal, to.normal);
}

/// Where closed things touch, a ray may meet the front of the one before the back of the other: it sees no back then.
bool PageBaker::is_enclosed(const Point& p) const {
  const V3 askew = p.face + V3(0.0137, 0.0271, 0.0419);
  return world_.encloses({world_.off_surface(p.position, p.face, p.extent), unit(askew)});
}

/// Of the points from `first` on. Few rays may all meet backs of what is open; it is a leak only where closed things
/// are all around.
Site PageBaker::site_of(std::span<const Irradiance> light, std::size_t first) const {
  if (std::ranges::any_of(light, [](const Irradiance& p) { return p.inside <= within; })) return Site::open;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Point& p = points_[first + i];
    if (light[i].inside < 1 || is_dark(light[i]) || !is_enclosed(p)) continue;
    if (light[i].by_lamp || is_lit_from_outside(world_, p)) return Site::pierced;
  }
  return Site::within;
}

Point PageBaker::point(const SurfaceSample& s) const {
  const FacetRef& ref = page_.refs[s.triangle];
  const Part& part = parts_[ref.part];
  const auto& use = world_.stage().uses[ref.use];
  const Affine& frame = world_.stage().frames[use.frame];
  const std::size_t c = 3 * std::size_t{ref.triangle};
  const V3 corner[3] = {part.position(c), part.position(c + 1), part.position(c + 2)};
  V3 position, normal;
  for (int k = 0; k < 3; ++k) {
    position += double{s.weight[k]} * corner[k];
    normal += double{s.weight[k]} * part.normal(c + k);
  }
  Point p;
  p.position = frame.point(position);
  p.face = unit(frame.normal(cross(corner[1] - corner[0], corner[2] - corner[0])));
  p.normal = unit(frame.normal(normal));
  if (!(dot(p.face, p.face) > 0.5)) p.face = p.normal;
  // Who has directions corrects for the normal himself (light/render/baked.h).
  if (flat_ || !(dot(p.normal, p.face) > 0)) p.normal = p.face;
  p.use = ref.use;
  p.extent = std::max(length(frame.vector(corner[1] - corner[0])), length(frame.vector(corner[2] - corner[0])));
  return p;
}

}  // namespace wrlkit::bake

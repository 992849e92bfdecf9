#include "passes/lightmap/bake.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "passes/lightmap/checkpoint.h"
#include "passes/lightmap/denoise.h"
#include "passes/lightmap/fill.h"
#include "passes/lightmap/page.h"
#include "passes/lightmap/specks.h"

namespace wrlkit::bake {
namespace {

using drawing::Affine;
using drawing::V3;
using light::Irradiance;
using light::Point;

constexpr double pi = 3.14159265358979323846;
constexpr int grid = 4;                      // points along each side of a texel that may be lit
constexpr std::size_t most_cache_points = 100'000;
constexpr float within = 0.5f;               // share of rays that meet backs, from which on a point lies inside something

Vec vec(const V3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
Rgb rgb(const light::Rgb& c) { return {c[0], c[1], c[2]}; }

/// Where the points of a texel lie.
enum class Site : std::uint32_t {
  open,
  within,                                    // something: what few rays see is not the light there
  pierced,                                   // within something on all sides, and yet a lamp shines there: a leak
};

/// What is kept of a texel: what the checkpoint holds.
struct TexelLight {
  std::int32_t x, y;
  std::uint32_t chart;
  Site site;
  Rgb light, along[3];
  float variance;
  Vec position, normal;
};

class PageBaker {
 public:
  PageBaker(const std::vector<Part>& parts, const PageLayout& page, const light::LightWorld& world, bool flat)
      : parts_(parts), page_(page), world_(world), flat_(flat), grid_(page.triangles, page.width, page.height) {}

  std::size_t n_tiles() const { return grid_.n_tiles(); }

  /// Points of the surface for a tile's samples, in their order; of a grid with so many along each side of a texel.
  const std::vector<Point>& points(std::size_t tile, int samples, int side = grid) {
    grid_.texels_of(tile, side, samples, texels_);
    points_.clear();
    for (const auto& s : texels_.samples) points_.push_back(point(s));
    return points_;
  }

  /// The light of each texel of the tile whose points were asked for last.
  std::vector<TexelLight> gather(std::vector<Irradiance> light) const {
    std::vector<TexelLight> out;
    for (std::size_t i = 0; i < light.size(); ++i)
      if (is_dark(light[i]) && is_enclosed(points_[i])) light[i].inside = 1;
    for (const auto& t : texels_.texels) {
      const std::span all(&light[t.first], t.count);
      TexelLight texel{t.x, t.y, page_.triangles[texels_.samples[t.first].triangle].chart, site_of(all, t.first), {}, {}, 0, {}, {}};
      float weight = 0;  // of a point that lies within something, as far as it sees out; such light counts where there is no other
      for (const Irradiance& l : all) {
        if (texel.site == Site::open && l.inside > within) continue;
        add(l, texel);
        weight += texel.site == Site::open ? 1 : 1 - l.inside;
      }
      const auto scale = weight > 0 ? static_cast<float>(1 / (pi * weight)) : 0;
      texel.light = scale * texel.light;
      for (Rgb& a : texel.along) a = scale * a;
      texel.variance *= scale * scale;
      const Point& middle = points_[t.first + t.count / 2];
      texel.position = vec(middle.position - world_.centre());
      texel.normal = vec(middle.normal);
      out.push_back(texel);
    }
    return out;
  }

 private:
  static bool is_dark(const Irradiance& p) { return !(luminance(rgb(p.direct)) + luminance(rgb(p.indirect)) > 0); }

  /// Where closed things touch, a ray may meet the front of the one before the back of the other: it sees no back then.
  bool is_enclosed(const Point& p) const {
    const V3 askew = p.face + V3(0.0137, 0.0271, 0.0419);
    return world_.encloses({world_.off_surface(p.position, p.face, p.extent), unit(askew)});
  }

  /// Of the points from `first` on. Few rays may all meet backs of what is open; it is a leak only where closed things are all around.
  Site site_of(std::span<const Irradiance> light, std::size_t first) const {
    if (std::ranges::any_of(light, [](const Irradiance& p) { return p.inside <= within; })) return Site::open;
    for (std::size_t i = 0; i < light.size(); ++i)
      if (light[i].inside == 1 && light[i].by_lamp && is_enclosed(points_[first + i])) return Site::pierced;
    return Site::within;
  }

  static void add(const Irradiance& from, TexelLight& to) {
    to.light += rgb(from.direct) + rgb(from.indirect);
    for (int k = 0; k < 3; ++k) to.along[k] += rgb(from.along[k]);
    to.variance += luminance(rgb(from.variance));
  }

  Point point(const SurfaceSample& s) const {
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
    // Who has directions corrects for the normal himself (passes/render/baked.h).
    if (flat_ || !(dot(p.normal, p.face) > 0)) p.normal = p.face;
    p.use = ref.use;
    p.extent = std::max(length(frame.vector(corner[1] - corner[0])), length(frame.vector(corner[2] - corner[0])));
    return p;
  }

  const std::vector<Part>& parts_;
  const PageLayout& page_;
  const light::LightWorld& world_;
  bool flat_;                                // by the normal of the face, not by that of shading
  TexelGrid grid_;
  TileTexels texels_;
  std::vector<Point> points_;
};

/// A fair choice of the points that will be lit, for the cache of reflected light.
std::vector<Point> choose_points(std::vector<PageBaker>& pages) {
  std::vector<Point> all;
  for (PageBaker& p : pages)
    for (std::size_t tile = 0; tile < p.n_tiles(); ++tile) {
      const auto& points = p.points(tile, 1, 1);
      all.insert(all.end(), points.begin(), points.end());
    }
  if (all.size() <= most_cache_points) return all;
  std::vector<Point> some;
  for (std::size_t i = 0; i < most_cache_points; ++i) some.push_back(all[i * all.size() / most_cache_points]);
  return some;
}

/// Of all that the light of a tile depends on.
std::uint64_t key_of(const Layout& layout, const light::LightWorld& world, const BakeOptions& o) {
  const double numbers[] = {double(o.samples), double(o.integrator.mode), double(o.integrator.rays), o.integrator.error, double(o.integrator.most_rays),
                            o.integrator.cell, double(o.integrator.seed), world.radius(), world.centre().x, world.centre().y, world.centre().z};
  std::uint64_t h = hash_bytes(numbers, sizeof numbers);
  for (const auto& p : layout.pages()) {
    h = hash_bytes(p.triangles.data(), p.triangles.size() * sizeof(PlacedTriangle), h);
    h = hash_bytes(p.refs.data(), p.refs.size() * sizeof(FacetRef), h);
  }
  const auto& points = world.meshes().points;
  h = hash_bytes(points.data(), points.size() * sizeof points[0], h);
  for (const auto& f : world.stage().frames) h = hash_bytes(&f, sizeof f, h);
  for (const auto& l : world.lamps()) {
    const V3 v[] = {l.irradiance, l.light.location, l.light.direction, l.light.attenuation};
    h = hash_bytes(v, sizeof v, h);
  }
  for (const auto& e : world.emitters()) h = hash_bytes(&e.radiance, sizeof e.radiance, h);
  return h;
}

std::vector<TexelLight> unpack(const std::vector<char>& bytes) {
  std::vector<TexelLight> texels(bytes.size() / sizeof(TexelLight));
  if (!texels.empty()) std::memcpy(texels.data(), bytes.data(), texels.size() * sizeof(TexelLight));
  return texels;
}

std::vector<char> packed(const std::vector<TexelLight>& texels) {
  auto p = reinterpret_cast<const char*>(texels.data());
  return {p, p + texels.size() * sizeof(TexelLight)};
}

/// Texels within something have no light of their own. Where a whole chart is, it keeps what it sees.
std::vector<char> known_texels(const Page& page, const std::vector<char>& inside) {
  std::vector<char> lit_charts, known(page.size());
  auto lit = [&](std::uint32_t chart) -> char& {
    if (chart >= lit_charts.size()) lit_charts.resize(std::size_t{chart} + 1);
    return lit_charts[chart];
  };
  for (std::size_t i = 0; i < page.size(); ++i)
    if (page.covered(i) && !inside[i]) lit(page.places[i].chart) = 1;
  for (std::size_t i = 0; i < page.size(); ++i) known[i] = page.covered(i) && (!inside[i] || !lit(page.places[i].chart));
  return known;
}

/// From what was summed, radiance times cosine times direction, to the mean direction of radiance that lightmapDirection is.
/// Light from one direction has the same of both; light from all of a hemisphere 2/3 of its normal against 1/2. Between
/// them we go straight. Means can be mixed with those of texels of other brightness.
void make_directions(Page& page) {
  auto mean = [](float x, float y, float z, float all, float out[3]) {
    const float length = all > 0 ? std::min(1.0f, std::sqrt(x * x + y * y + z * z) / all) : 0;
    const float scale = all > 0 ? (0.75f + 0.75f * std::max(0.0f, length - 2.0f / 3)) / all : 0;
    out[0] = x * scale, out[1] = y * scale, out[2] = z * scale;
  };
  for (std::size_t i = 0; i < page.size(); ++i) {
    Rgb &x = page.layers[1][i], &y = page.layers[2][i], &z = page.layers[3][i];
    const Rgb& all = page.light()[i];
    float r[3], g[3], b[3];
    mean(x.r, y.r, z.r, all.r, r), mean(x.g, y.g, z.g, all.g, g), mean(x.b, y.b, z.b, all.b, b);
    x = {r[0], g[0], b[0]}, y = {r[1], g[1], b[1]}, z = {r[2], g[2], b[2]};
  }
}

BakedPage finish(Page page, const std::vector<char>& inside, const BakeOptions& options, Statistics& stats) {
  auto known = known_texels(page, inside);
  std::vector<std::uint32_t> chart;
  for (const Place& p : page.places) chart.push_back(p.chart);
  for (std::size_t i = 0; i < page.size(); ++i)
    if (!known[i]) page.places[i].chart = Place::nowhere;
  if (options.denoise) denoise(page);
  stats["lightmap.holes"] += count_specks(page);
  if (page.layers.size() > 1) make_directions(page);
  fill_charts(page.layers, known, chart, Place::nowhere, page.width, page.height);
  for (auto& layer : page.layers) fill(layer, known, page.width, page.height);
  BakedPage out{{page.width, page.height, std::move(page.layers[0]), inside}, {}};
  for (std::size_t l = 1; l < page.layers.size(); ++l) out.direction.push_back({page.width, page.height, std::move(page.layers[l]), {}});
  return out;
}

}  // namespace

std::vector<BakedPage> bake(const std::vector<Part>& parts, const Layout& layout, const light::LightWorld& world, const BakeOptions& options, PassContext& ctx) {
  std::vector<PageBaker> bakers;
  std::uint64_t n_tiles = 0;
  for (const auto& p : layout.pages()) n_tiles += bakers.emplace_back(parts, p, world, options.directional).n_tiles();
  const light::Integrator integrator(world, choose_points(bakers), options.integrator);
  Checkpoint checkpoint(options.checkpoint, key_of(layout, world, options));
  if (ctx.monitor) ctx.monitor->begin("baking", n_tiles, "tiles");

  std::vector<BakedPage> out;
  std::uint64_t number = 0;  // of the tile, over all pages
  for (std::size_t p = 0; p < bakers.size(); ++p) {
    Page page(layout.pages()[p].width, layout.pages()[p].height, options.directional ? 4 : 1);
    std::vector<char> inside(page.size());
    for (std::size_t tile = 0; tile < bakers[p].n_tiles(); ++tile, ++number) {
      std::vector<TexelLight> texels;
      if (auto* saved = checkpoint.find(number)) {
        texels = unpack(*saved);
      } else if (const auto& points = bakers[p].points(tile, options.samples); !points.empty()) {
        const auto light = integrator.irradiance(points, number * TexelGrid::tile * TexelGrid::tile * options.samples);
        texels = bakers[p].gather(light);
        ctx.stats["lightmap.samples"] += points.size();
        for (const auto& l : light) ctx.stats["lightmap.rays"] += l.rays;
        checkpoint.save(number, packed(texels));
      }
      for (const auto& t : texels) {
        const auto i = page.at(t.x, t.y);
        page.light()[i] = t.light;
        for (std::size_t l = 1; l < page.layers.size(); ++l) page.layers[l][i] = t.along[l - 1];
        page.variance[i] = t.variance;
        page.places[i] = {t.chart, t.position, t.normal};
        inside[i] = t.site != Site::open;
        ctx.stats["lightmap.inside"] += inside[i];
        ctx.stats["lightmap.leaks"] += t.site == Site::pierced;
        ctx.stats["lightmap.black"] += t.site == Site::open && !(t.light.r + t.light.g + t.light.b > 0);
      }
      ctx.stats["lightmap.texels"] += texels.size();
      if (ctx.monitor) ctx.monitor->step();
    }
    out.push_back(finish(std::move(page), inside, options, ctx.stats));
  }

  std::vector<Canvas> light;
  for (auto& p : out) light.push_back(std::move(p.light));
  const SeamReport seams = close_seams(light, layout.seams());
  ctx.stats["lightmap.seam-places"] += seams.places;
  ctx.stats["lightmap.jumps"] += seams.jumps;
  for (std::size_t p = 0; p < out.size(); ++p) out[p].light = std::move(light[p]);
  checkpoint.finish();
  return out;
}

}  // namespace wrlkit::bake

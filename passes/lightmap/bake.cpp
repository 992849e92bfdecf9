#include "passes/lightmap/bake.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <span>
#include <system_error>

#include "base/parallel.h"
#include "base/stop.h"
#include "passes/lightmap/borders.h"
#include "passes/lightmap/checkpoint.h"
#include "passes/lightmap/cut_off.h"
#include "passes/lightmap/denoise.h"
#include "passes/lightmap/fill.h"
#include "passes/lightmap/finest_light.h"
#include "passes/lightmap/hidden_charts.h"
#include "passes/lightmap/page.h"
#include "passes/lightmap/page_baker.h"
#include "passes/lightmap/refine.h"
#include "passes/lightmap/specks.h"
#include "passes/lightmap/work_key.h"

namespace wrlkit::bake {
namespace {

using drawing::V3;
using light::Point;

constexpr std::size_t most_cache_points = 100'000;

/// What a page has of the light of finer levels.
struct Inherited {
  std::vector<Rgb> light;     // by texel
  std::vector<char> missing;  // by texel: it has none. Empty: all have none
};

/// How far from the finer level a simpler one may be: of its box, and texels.
double reach_of(const Part& p, const drawing::Affine& frame, double density) {
  constexpr double of_box = 0.05, texels = 2;
  Box box;
  for (std::size_t c = 0; c < p.mesh.corners.size(); ++c) box.add(frame.point(p.position(c)));
  return of_box * drawing::length(box.size()) + texels / (density * p.density);
}

Inherited inherit(PageBaker& from, const std::vector<double>& reach, const BakeOptions& options) {
  Inherited out;
  if (!options.finest) return out;
  const PageLayout& page = from.page();
  const std::size_t n = std::size_t(page.width) * page.height;
  out.light.resize(n);
  out.missing.assign(n, 1);
  for (std::size_t tile = 0; tile < from.n_tiles(); ++tile) {
    const auto& points = from.points(tile, 1, 1);
    const auto texels = from.texels();
    parallel_for(texels.size(), [&](std::size_t t) {
      const Point& p = points[texels[t].first];
      const NodeId shape = from.world().stage().uses[p.use].shape;
      const auto light = options.finest->at(shape, p.position, p.normal, reach[p.use]);
      if (!light) return;
      const std::size_t i = std::size_t(texels[t].y) * page.width + texels[t].x;
      out.light[i] = *light;
      out.missing[i] = 0;
    });
  }
  return out;
}

std::vector<Inherited> inherit_all(std::vector<PageBaker>& pages, const std::vector<Part>& parts, const Layout& layout,
                                   const BakeOptions& options) {
  std::vector<Inherited> out(pages.size());
  if (!options.finest || pages.empty()) return out;
  const auto& stage = pages[0].world().stage();
  std::vector<double> reach(stage.uses.size());
  for (const Part& p : parts)
    for (const std::uint32_t u : p.uses) reach[u] = reach_of(p, stage.frames[stage.uses[u].frame], layout.density());
  for (std::size_t i = 0; i < pages.size(); ++i) out[i] = inherit(pages[i], reach, options);
  return out;
}

/// A point of each texel that will be lit.
std::vector<Point> point_of_each(std::vector<PageBaker>& pages, const std::vector<Inherited>& inherited) {
  std::vector<Point> all;
  for (std::size_t i = 0; i < pages.size(); ++i)
    for (std::size_t tile = 0; tile < pages[i].n_tiles(); ++tile) {
      check_stop();
      const auto& points = pages[i].points(tile, 1, 1, inherited[i].missing);
      all.insert(all.end(), points.begin(), points.end());
    }
  return all;
}

/// A fair choice, for the cache of reflected light.
std::vector<Point> some_of(std::vector<Point> all) {
  if (all.size() <= most_cache_points) return all;
  std::vector<Point> some;
  for (std::size_t i = 0; i < most_cache_points; ++i) some.push_back(all[i * all.size() / most_cache_points]);
  return some;
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

/// By chart.
std::vector<std::uint32_t> uses_of_charts(const PageLayout& page) {
  std::vector<std::uint32_t> out;
  for (std::size_t t = 0; t < page.triangles.size(); ++t) {
    const auto chart = page.triangles[t].chart;
    if (chart >= out.size()) out.resize(std::size_t{chart} + 1);
    out[chart] = page.refs[t].use;
  }
  return out;
}

/// What lies within something though it stands for a finer level that did not, or is black, looks as the nearest place
/// of that.
void take_from_finest(const Page& page, PageLight& light, std::vector<char>& inside, const PageBaker& from,
                      const BakeOptions& options) {
  if (!options.finest) return;
  const auto use_of = uses_of_charts(from.page());
  const auto& uses = from.world().stage().uses;
  parallel_for(page.size(), [&](std::size_t i) {
    if (!page.covered(i) || (!inside[i] && luminance(light.at(i)) > 0)) return;
    const TexelPlace& p = page.places[i];
    const auto found = options.finest->anywhere(uses[use_of[p.chart]].shape,
                                                V3(p.position.x, p.position.y, p.position.z) + from.world().centre(),
                                                {p.normal.x, p.normal.y, p.normal.z});
    if (!found) return;
    light.direct.light()[i] = {};
    light.gathered.light()[i] = *found;
    light.direct.variance[i] = light.gathered.variance[i] = 0;
    inside[i] = 0;
  });
}

/// Texels within something have no light of their own. Where a whole chart is, it keeps what it sees, if it sees
/// anything.
std::vector<char> known_texels(const Page& page, const PageLight& light, const std::vector<char>& inside) {
  constexpr char in_the_open = 2, sees = 1;
  std::vector<char> lit_charts, known(page.size());
  auto lit = [&](std::uint32_t chart) -> char& {
    if (chart >= lit_charts.size()) lit_charts.resize(std::size_t{chart} + 1);
    return lit_charts[chart];
  };
  for (std::size_t i = 0; i < page.size(); ++i)
    if (page.covered(i)) lit(page.places[i].chart) |= !inside[i] ? in_the_open : luminance(light.at(i)) > 0 ? sees : 0;
  for (std::size_t i = 0; i < page.size(); ++i)
    known[i] = page.covered(i) && (!inside[i] || lit(page.places[i].chart) == sees);
  return known;
}

/// From what was summed, radiance times cosine times direction, to the mean direction of radiance that
/// lightmapDirection is. Light from one direction has the same of both; light from all of a hemisphere 2/3 of its
/// normal against 1/2. Between them we go straight. Means can be mixed with those of texels of other brightness. Light
/// that no picture shows has none: processors may be set to take the smallest numbers for 0, and not all threads are
/// alike in that.
void make_directions(Estimate& whole) {
  constexpr float faint = 1e-6f;
  auto mean = [](float x, float y, float z, float all, float out[3]) {
    const float length = all > faint ? std::min(1.0f, std::sqrt(x * x + y * y + z * z) / all) : 0;
    const float scale = all > faint ? (0.75f + 0.75f * std::max(0.0f, length - 2.0f / 3)) / all : 0;
    out[0] = x * scale;
    out[1] = y * scale;
    out[2] = z * scale;
  };
  for (std::size_t i = 0; i < whole.light().size(); ++i) {
    Rgb &x = whole.layers[1][i], &y = whole.layers[2][i], &z = whole.layers[3][i];
    const Rgb& all = whole.light()[i];
    float r[3], g[3], b[3];
    mean(x.r, y.r, z.r, all.r, r);
    mean(x.g, y.g, z.g, all.g, g);
    mean(x.b, y.b, z.b, all.b, b);
    x = {r[0], g[0], b[0]};
    y = {r[1], g[1], b[1]};
    z = {r[2], g[2], b[2]};
  }
}

/// Directions are of all light, so they are filtered with the whole of it.
std::vector<std::vector<Rgb>> directions(const Page& page, const PageLight& light, bool denoised) {
  if (light.along.empty()) return {};
  Estimate whole = light.direct;
  for (std::size_t i = 0; i < page.size(); ++i) {
    whole.light()[i] += light.gathered.light()[i];
    whole.variance[i] += light.gathered.variance[i];
  }
  std::ranges::copy(light.along, std::back_inserter(whole.layers));
  if (denoised) denoise(page, whole);
  make_directions(whole);
  return {std::make_move_iterator(whole.layers.begin() + 1), std::make_move_iterator(whole.layers.end())};
}

/// Where texels next to the charts that have light take theirs from.
std::vector<std::uint32_t> beyond_borders(std::span<const std::uint32_t> chart, const std::vector<char>& known,
                                          const Page& page) {
  std::vector<std::uint16_t> number;
  for (std::size_t i = 0; i < chart.size(); ++i)
    number.push_back(known[i] && chart[i] != TexelPlace::nowhere ? chart_number(chart[i]) : 0);
  const ChartMap map{number, page.width, page.height};
  return sources_beyond_borders(map, last_separate_level(map));
}

BakedPage finish(Page page, PageLight light, std::vector<char> inside, const PageBaker& from,
                 const BakeOptions& options, Statistics& stats) {
  lighten_cut_off(page, light, inside, from.world());
  take_from_finest(page, light, inside, from, options);
  const auto n_texels = static_cast<std::size_t>(
      std::ranges::count_if(page.places, [](const TexelPlace& p) { return p.chart != TexelPlace::nowhere; }));
  stats["lightmap.texels"] += n_texels;
  for (std::size_t i = 0; i < page.size(); ++i) {
    stats["lightmap.inside"] += inside[i];
    const Rgb all = light.at(i);
    stats["lightmap.black"] += page.covered(i) && !inside[i] && !(all.r + all.g + all.b > 0);
  }
  auto known = known_texels(page, light, inside);
  std::vector<std::uint32_t> chart;
  for (const TexelPlace& p : page.places) chart.push_back(p.chart);
  for (std::size_t i = 0; i < page.size(); ++i)
    if (!known[i]) page.places[i].chart = TexelPlace::nowhere;
  auto layers = directions(page, light, options.denoise);
  layers.insert(layers.begin(), shown_light(page, std::move(light.direct), std::move(light.gathered), options.denoise));
  stats["lightmap.holes"] += count_specks(page, layers[0]);
  light::LightMeter meter;
  for (std::size_t i = 0; i < page.size(); ++i)
    if (page.covered(i)) meter.add(luminance(layers[0][i]));
  fill_charts(layers, known, chart, TexelPlace::nowhere, page.width, page.height);
  auto dark = dark_uses(from.page(), chart, layers[0]);
  light_hidden_charts(page, chart, uses_of_charts(from.page()), known, layers[0]);
  const auto sources = beyond_borders(chart, known, page);
  for (auto& layer : layers) {
    fill(layer, known, page.width, page.height);
    extend_borders(layer, sources);
  }
  BakedPage out{{page.width, page.height, std::move(layers[0]), inside}, {}, n_texels, std::move(dark), meter};
  for (std::size_t l = 1; l < layers.size(); ++l)
    out.direction.push_back({page.width, page.height, std::move(layers[l]), {}});
  return out;
}

/// Of two estimates that are equally good. What is within something as far as few rays tell may be in the open.
TexelLight mean(const TexelLight& a, const TexelLight& b) {
  if (a.site != b.site) return a.site == Site::open || (a.site == Site::pierced && b.site != Site::open) ? a : b;
  TexelLight out = a;
  auto mix = [](Rgb& x, const Rgb& y) { x = 0.5f * (x + y); };
  mix(out.direct, b.direct);
  mix(out.gathered, b.gathered);
  for (int k = 0; k < 3; ++k) mix(out.along[k], b.along[k]);
  out.direct_apart = 0.5f * (a.direct - b.direct);
  out.gathered_apart = 0.5f * (a.gathered - b.gathered);
  auto square = [](float v) {
    return v * v;
  };  // it knows what a lattice saves, and what lies between the points of a texel
  out.direct_variance = square(luminance(out.direct_apart));
  out.gathered_variance = square(luminance(out.gathered_apart));
  return out;
}

std::string title_of_page(const std::string& title, std::size_t page, std::size_t n_pages) {
  return n_pages == 1 ? title : title + ", page " + std::to_string(page + 1) + " of " + std::to_string(n_pages);
}

/// Light comes in rounds: one for all texels or, where an error is asked for, as many as it takes, each with as many
/// rays as those before it.
class Rounds {
 public:
  /// `integrators` is of one, of none where all light is inherited, and of two where an error is asked for: what the
  /// halves of the rays look up has nothing in common then, so that they tell the error of that, too.
  Rounds(std::span<const light::Integrator> integrators, Checkpoint& checkpoint, const BakeOptions& options,
         std::uint64_t n_tiles, PassContext& ctx)
      : integrators_(integrators), checkpoint_(checkpoint), options_(options), n_tiles_(n_tiles), ctx_(ctx) {}

  /// `first` is the number of the page's first tile.
  BakedPage bake(PageBaker& from, std::uint64_t first, Inherited inherited, const std::string& name) {
    name_ = name;
    Page page(from.page().width, from.page().height);
    PageLight light(page, options_.directional);
    std::vector<char> inside(page.size()), chosen = std::move(inherited.missing);
    const bool once = !(options_.error > 0);
    Halves halves(once ? 0 : page.size());
    const int rays = options_.rays;
    if (!chosen.empty()) take_inherited(from, inherited.light, chosen, page, light, inside, halves);
    run(from, first, 0, {0, rays}, chosen, [&](const TexelLight& t) { take(t, page, light, inside, halves); });
    for (std::uint32_t round = 1; !once && rays << round <= options_.most_rays; ++round) {
      auto next = unsettled(in_the_open(page, inside), light, halves, options_.error, options_.denoise);
      for (std::size_t i = 0; i < chosen.size(); ++i) next[i] &= chosen[i];
      chosen = std::move(next);
      if (std::ranges::find(chosen, 1) == chosen.end()) break;
      run(from, first, round, {static_cast<std::uint32_t>(rays << (round - 1)), rays << (round - 1)}, chosen,
          [&](const TexelLight& t) { add(t, page, light, inside, halves); });
    }
    return finish(std::move(page), std::move(light), inside, from, options_, ctx_.stats);
  }

 private:
  /// Calls f(texel) for the chosen texels of all tiles of a page.
  template <class F>
  void run(PageBaker& from, std::uint64_t first, std::uint32_t number_of_round, const light::Integrator::Round& round,
           const std::vector<char>& chosen, F&& f) {
    if (ctx_.monitor && options_.error > 0)
      ctx_.monitor->begin(number_of_round ? name_ + ", round " + std::to_string(number_of_round + 1) : name_,
                          from.n_tiles(), "tiles");
    for (std::size_t tile = 0; tile < from.n_tiles(); ++tile) {
      const std::uint64_t number = number_of_round * n_tiles_ + first + tile;
      std::vector<TexelLight> texels;
      if (auto* saved = checkpoint_.find(number)) {
        texels = unpack(*saved);
      } else if (const auto& points = from.points(tile, options_.samples, PageBaker::grid, chosen); !points.empty()) {
        texels = gather(from, points, (first + tile) * TexelGrid::tile * TexelGrid::tile * options_.samples, round);
        ctx_.stats["lightmap.samples"] += number_of_round ? 0 : points.size();
        checkpoint_.save(number, packed(texels));
      }
      for (const auto& t : texels) f(t);
      if (ctx_.monitor) ctx_.monitor->step();
    }
  }

  /// Two estimates, each with half of the rays, tell of an error that is asked for.
  std::vector<TexelLight> gather(const PageBaker& from, const std::vector<Point>& points, std::uint64_t number,
                                 const light::Integrator::Round& round) {
    auto ask = [&](std::uint64_t half, std::uint32_t share) {
      const auto light = integrators_[half].irradiance(points, number + (half << 48),
                                                       {round.first / share, round.rays / int(share), from.numbers()});
      for (const auto& l : light) ctx_.stats["lightmap.rays"] += l.rays;
      return from.gather(light);
    };
    if (!(options_.error > 0)) return ask(0, 1);
    auto texels = ask(0, 2);
    const auto others = ask(1, 2);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = mean(texels[i], others[i]);
    return texels;
  }

  void take_inherited(PageBaker& from, const std::vector<Rgb>& inherited, const std::vector<char>& missing, Page& page,
                      PageLight& light, std::vector<char>& inside, Halves& halves) {
    for (std::size_t tile = 0; tile < from.n_tiles(); ++tile) {
      from.points(tile, 1, 1);
      for (const TexelSamples& t : from.texels()) {
        const std::size_t i = page.at(t.x, t.y);
        if (missing[i]) continue;
        TexelLight texel = from.place(t);
        texel.gathered = inherited[i];
        take(texel, page, light, inside, halves);
        ++ctx_.stats["lightmap.inherited"];
      }
    }
  }

  void take(const TexelLight& t, Page& page, PageLight& light, std::vector<char>& inside, Halves& halves) {
    const auto i = page.at(t.x, t.y);
    light.direct.light()[i] = t.direct;
    light.direct.variance[i] = t.direct_variance;
    light.gathered.light()[i] = t.gathered;
    light.gathered.variance[i] = t.gathered_variance;
    for (std::size_t l = 0; l < light.along.size(); ++l) light.along[l][i] = t.along[l];
    if (!halves.direct.empty()) {
      halves.direct[i] = t.direct_apart;
      halves.gathered[i] = t.gathered_apart;
    }
    page.places[i] = {t.chart, t.position, t.normal};
    inside[i] = t.site != Site::open;
    ctx_.stats["lightmap.leaks"] += t.site == Site::pierced;
  }

  /// A second estimate, as good as the first.
  static void add(const TexelLight& t, const Page& page, PageLight& light, std::vector<char>& inside, Halves& halves) {
    const auto i = page.at(t.x, t.y);
    const bool open = t.site == Site::open;
    if (!open && !inside[i]) return;
    const float share =
        open && inside[i] ? 1 : 0.5f;  // what was within something as far as few rays told may be in the open
    auto mix = [&](Rgb& mean, const Rgb& more) { mean = (1 - share) * mean + share * more; };
    auto join = [&](Estimate& mean, const Rgb& more, float variance) {
      mix(mean.light()[i], more);
      mean.variance[i] = (1 - share) * (1 - share) * mean.variance[i] + share * share * variance;
    };
    join(light.direct, t.direct, t.direct_variance);
    join(light.gathered, t.gathered, t.gathered_variance);
    mix(halves.direct[i], t.direct_apart);
    mix(halves.gathered[i], t.gathered_apart);
    for (std::size_t l = 0; l < light.along.size(); ++l) mix(light.along[l][i], t.along[l]);
    inside[i] = !open;
  }

  static Page in_the_open(Page page, const std::vector<char>& inside) {
    for (std::size_t i = 0; i < page.size(); ++i)
      if (inside[i]) page.places[i].chart = TexelPlace::nowhere;
    return page;
  }

  std::span<const light::Integrator> integrators_;
  Checkpoint& checkpoint_;
  const BakeOptions& options_;
  std::uint64_t n_tiles_;
  PassContext& ctx_;
  std::string name_;  // of the page
};

}  // namespace

std::vector<BakedPage> bake(const std::vector<Part>& parts, const Layout& layout, const light::LightWorld& world,
                            const BakeOptions& options, PassContext& ctx) {
  std::vector<PageBaker> bakers;
  std::uint64_t n_tiles = 0;
  for (const auto& p : layout.pages()) n_tiles += bakers.emplace_back(parts, p, world, options.directional).n_tiles();
  const auto inherited = inherit_all(bakers, parts, layout, options);
  if (ctx.monitor) ctx.monitor->begin(options.title + ": reflected light", 0, "");
  auto all = point_of_each(bakers, inherited);
  const auto n_points = static_cast<double>(all.size()) * options.samples;
  const auto points = some_of(std::move(all));
  std::vector<light::Integrator> integrators;
  for (int i = 0; i < (options.error > 0 ? 2 : 1) && !points.empty(); ++i) {
    light::IntegratorOptions how = options.integrator;
    how.cache = i;
    how.points = n_points;
    integrators.emplace_back(world, points, how);
  }
  Checkpoint checkpoint(options.checkpoint, options.checkpoint.empty() ? 0 : work_key(parts, layout, world, options));
  if (checkpoint.has_replaced_another()) ctx.diag.report(Diag::file_replaced, {}, options.checkpoint);
  Rounds rounds(integrators, checkpoint, options, n_tiles, ctx);

  // How many rounds a page takes is not known before; all else is one stretch of work.
  if (ctx.monitor && !(options.error > 0)) ctx.monitor->begin(options.title, n_tiles, "tiles");
  std::vector<BakedPage> out;
  std::uint64_t first = 0;
  for (std::size_t p = 0; p < bakers.size(); first += bakers[p++].n_tiles())
    out.push_back(rounds.bake(bakers[p], first, inherited[p], title_of_page(options.title, p, bakers.size())));

  if (checkpoint.error())
    ctx.diag.report(Diag::cannot_write, {}, options.checkpoint, std::generic_category().message(checkpoint.error()));
  std::vector<Canvas> light;
  for (auto& p : out) light.push_back(std::move(p.light));
  const SeamReport seams = close_seams(light, layout.seams());
  ctx.stats["lightmap.seam-places"] += seams.places;
  ctx.stats["lightmap.jumps"] += seams.jumps;
  for (std::size_t p = 0; p < out.size(); ++p) out[p].light = std::move(light[p]);
  return out;
}

}  // namespace wrlkit::bake

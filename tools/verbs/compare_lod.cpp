// wrlkit compare-lod: what each criterion makes of a scene at the same numbers of triangles, as a page of charts,
// figures and pictures, or as one picture. The keys of --json are stable.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numbers>

#include "base/text/json.h"
#include "tools/cli/session.h"
#include "tools/report/comparison.h"
#include "tools/verbs/render_options.h"

namespace wrlkit {
namespace {

/// Draws scenes that are the same except for their meshes, from where the first is seen.
class Painter {
 public:
  explicit Painter(Session& s) : s_(s), options_(render_options(s.flags())) {
    options_.width = options_.height = s.flags().picture_size;
    if (!options_.background) options_.background = Vec3{1, 1, 1};
  }

  /// Null when the passes failed. The messages about a scene are printed with the first picture.
  std::optional<Image> draw(Scene scene) {
    Diagnostics unheard(s_.diag().shared_sources());
    auto& diag = drawn_ ? unheard : s_.diag();
    PassContext ctx{diag, s_.context().stats, &s_.resources()};
    std::string why;
    auto pipeline = Pipeline::parse("picture", why);
    auto meshes = pipeline->run_lazily(scene, ctx);
    if (!meshes) return std::nullopt;
    if (!drawn_) options_ = with_camera(scene, meshes, options_, diag);
    drawn_ = true;
    return render(scene, meshes, options_, &s_.resources(), diag);
  }

 private:
  Session& s_;
  RenderOptions options_;
  bool drawn_ = false;
};

/// What to stop at: falling, each once. What is not less than the model is the model.
std::vector<std::size_t> counts_of(const Flags& f, std::size_t n_faces) {
  std::vector<std::size_t> out(f.counts.begin(), f.counts.end());
  constexpr double usual[] = {0.5, 0.25, 0.1, 0.05, 0.02, 0.01};
  auto add = [&](const auto& ratios) {
    for (double r : ratios) out.push_back(static_cast<std::size_t>(r * static_cast<double>(n_faces)));
  };
  if (!f.ratios.empty())
    add(f.ratios);
  else if (out.empty())
    add(usual);
  for (auto& n : out) n = std::clamp<std::size_t>(n, 1, n_faces);
  std::ranges::sort(out, std::greater{});
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::optional<ComparedCriterion> run_criterion(Session& s, Painter& painter, const std::string& name,
                                               const Comparison& c) {
  CriterionName criterion;
  criterion.read(name);
  WorldSimplifyOptions options{.collapse = {.criterion = criterion.value}, .counts = c.counts};
  options.collapse.keep_borders = options.collapse.keep_creases = !s.flags().bare;
  Diagnostics unheard(s.diag().shared_sources());
  PassContext silent{unheard, s.context().stats, &s.resources()};
  const SimplifiedWorld world(s.world().scene, options, silent);
  ComparedCriterion out{name, {}, {}};
  if (c.counts[0] == c.n_faces) {
    out.points.push_back({.n_faces = c.n_faces});
    out.pictures.push_back(c.picture);
  }
  for (std::size_t i = 0; i < world.n_points(); ++i) {
    auto picture = painter.draw(world.scene_at(i));
    if (!picture) return std::nullopt;
    out.points.push_back(world.point(i));
    out.pictures.push_back(std::move(*picture));
  }
  return out;
}

std::optional<Comparison> compare(Session& s) {
  Comparison c{.model = std::filesystem::path(s.flags().inputs[0]).filename().string()};
  c.n_faces = SimplifiedWorld(s.world().scene, {}, s.context()).n_faces();
  if (c.n_faces == 0) {
    fmt::print(stderr, "wrlkit compare-lod: there is no surface to simplify\n");
    return std::nullopt;
  }
  c.counts = counts_of(s.flags(), c.n_faces);
  Painter painter(s);
  auto picture = painter.draw(s.world().scene);
  if (!picture) return std::nullopt;
  c.picture = std::move(*picture);
  for (const auto& name : s.flags().criteria.empty() ? criterion_names() : s.flags().criteria) {
    s.progress().begin(name, 0, "");
    auto criterion = run_criterion(s, painter, name, c);
    if (!criterion) return std::nullopt;
    c.criteria.push_back(std::move(*criterion));
  }
  s.progress().clear();
  return c;
}

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::string figures_json(const Comparison& c) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.member("triangles", c.n_faces);
      json.list("criteria", c.criteria, [&](const auto& criterion) {
        json.object([&] {
          json.member("name", criterion.name);
          json.list("levels", criterion.points, [&](const auto& p) {
            json.object("triangles", p.n_faces, "rms", p.rms, "max", p.error, "normal_degrees", degrees(p.normals),
                        "seconds", p.seconds);
          });
        });
      });
    });
  });
}

std::string figures_text(const Comparison& c) {
  std::string out = fmt::format("{:<14}  {:>10}  {:>10}  {:>10}  {:>8}  {:>8}\n", "criterion", "triangles", "rms",
                                "max", "degrees", "seconds");
  for (const auto& criterion : c.criteria)
    for (const auto& p : criterion.points)
      out += fmt::format("{:<14}  {:>10}  {:>10.3g}  {:>10.3g}  {:>8.2f}  {:>8.3f}\n", criterion.name, p.n_faces, p.rms,
                         p.error, degrees(p.normals), p.seconds);
  return out;
}

bool write(const Comparison& c, Session& s) {
  const auto& name = s.flags().output;
  std::string why;
  const auto bytes = name.ends_with(".png") ? encode_png(comparison_sheet(c), why) : comparison_page(c, why);
  if (!bytes) {
    s.diag().report(Diag::cannot_write, {}, name, why);
    return false;
  }
  return write_text_file(name, *bytes);
}

bool has_one_budget(const Flags& f) {
  if (f.counts.empty() || f.ratios.empty()) return true;
  fmt::print(stderr, "wrlkit compare-lod: --counts or --ratios, not both\n");
  return false;
}

}  // namespace

int run_compare_lod(const Flags& flags) {
  Session s(flags);
  if (!has_one_budget(flags) || !s.good() ||
      !s.choose_pipeline(flags.pipeline_given ? "lower-vrml1,lower-x3d{vrml97=true}"
                                              : "lower-vrml1,inline,lower-x3d{vrml97=true},weld"))
    return usage;
  if (s.printed_pipeline()) return done;
  if (!s.read(flags.inputs[0]) || !s.pipeline().run(s.world().scene, s.context(), s.pipeline_options()))
    return s.end(false);
  const auto comparison = compare(s);
  if (!comparison) return s.end(false);
  if (!write(*comparison, s)) return s.end(false);
  if (flags.json)
    s.print_json(figures_json(*comparison));
  else
    fmt::print("{}", figures_text(*comparison));
  return s.end(true);
}

}  // namespace wrlkit

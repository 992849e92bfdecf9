#include "geometry/simplify/ladder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "base/math/box.h"
#include "base/math/vec.h"
#include "geometry/flat_colors.h"
#include "geometry/simplify/fitted_surface.h"
#include "geometry/triangulation.h"

namespace wrlkit::simplify {
namespace {

constexpr std::size_t every_below = 20;                           // triangles from which on each number is a rung
constexpr std::size_t fitted_below = 128;                         // triangles
constexpr std::size_t samples_of_face = 12, least_samples = 400;  // of a surface that is fitted
constexpr std::size_t most_fitted = 12'000;                       // where the criterion is held back
constexpr double spoiling = 30;                                   // growth of the distortion from rung to rung
constexpr double far = 5e-4;             // root of the mean square, as a share of the extent: from there on,
constexpr double spoiling_when_far = 4;  // less growth will do
constexpr double coarse_step = 0.7, fine_step = 0.85, finest_step = 0.9;
constexpr double most_missed = 0.05;  // share of the triangles of the world that lie between two rungs

class Ladder {
 public:
  explicit Ladder(const LadderPart& part)
      : part_(part),
        samples_(part.samples.begin(), part.samples.end()),
        surface_(triangles_of(part.mesh)),
        nearest_(surface_),
        colors_(FlatColors::of(part.mesh)),
        painted_(with_whole_faces(part.mesh)) {
    if (colors_) {
      original_.regions = &regions_.emplace(surface_, colors_->regions(), colors_->n_regions());
      find_regions(original_, samples_);
    }
    wrlkit::Box bounds;
    double area = 0;
    for (const auto& s : samples_) {
      bounds.add(s.point);
      area += s.weight;
    }
    if (part.share > 0) step_ = std::clamp(1 - most_missed / part.share, coarse_step, finest_step);
    const double distance = far * diagonal(bounds);
    spacing_ = std::sqrt(area / static_cast<double>(std::max<std::size_t>(samples_.size(), 1)));
    if (fits()) far_squares_ = 2 * area * distance * distance;
  }

  std::vector<Rung> run() {
    rungs_.push_back({{}, part_.mesh.n_faces(), {}, false});
    const std::size_t last = fits() ? fitted_below : 1;
    PlainMesh coarse;
    if (part_.mesh.n_faces() > last)
      coarse = collapse(last);
    else
      coarse = plain(part_.mesh);
    if (fits() && coarse.faces.size() <= most_fitted) fit(std::move(coarse));
    return std::move(rungs_);
  }

 private:
  bool fits() const { return !part_.mesh.lightcoord.present() && !samples_.empty(); }

  /// Of the faces of a level: by their colours, and where these have gone, by what is nearest. Nothing without colours.
  std::vector<std::uint32_t> regions_in(const Mesh& level) const {
    if (!colors_) return {};
    auto out = colors_->regions_of(level);
    const auto triangles = triangles_of(level);
    auto guess = ClosestPoint::no_guess;
    for (std::size_t f = 0; f < out.size(); ++f) {
      if (out[f] != FlatColors::none) continue;
      const auto t = triangles[f];
      guess = nearest_.nearest((1. / 3) * (t[0] + t[1] + t[2]), area_normal(t), guess).triangle;
      out[f] = guess == ClosestPoint::no_guess ? 0 : colors_->regions()[guess];
    }
    return out;
  }

  PlainMesh plain(const Mesh& mesh) const {
    PlainMesh out;
    out.regions = regions_in(mesh);
    const auto triangles = triangles_of(mesh);
    for (std::uint32_t i = 0; i < mesh.n_positions(); ++i) out.positions.push_back(triangles.position(i));
    for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3)
      out.faces.push_back({mesh.corners[i], mesh.corners[i + 1], mesh.corners[i + 2]});
    return out;
  }

  /// By the criterion, and where features and topology hold that back, by meshoptimizer, which minds them less; what is
  /// left at the end.
  PlainMesh collapse(std::size_t last) {
    const Mesh& first = painted_ ? *painted_ : part_.mesh;
    Mesh level = run(first, part_.collapse, last);
    const auto freely = Criterion::meshopt;
    if (level.n_faces() > most_fitted && part_.collapse.criterion != freely && info(freely).missing.empty() &&
        !part_.mesh.lightcoord.present()) {
      Mesh whole = first;
      for (Mesh* mesh : {&whole, &level})
        for (Attribute* a : mesh->attributes()) a->clear();
      auto from_level = std::exchange(rungs_, {rungs_.front()});
      run(whole, {.criterion = freely}, level.n_faces());
      std::swap(from_level, rungs_);
      level = run(level, {.criterion = freely}, last, most_fitted);
      rungs_.insert(rungs_.begin() + 1, std::make_move_iterator(from_level.begin() + 1),
                    std::make_move_iterator(from_level.end()));
    }
    return plain(level);
  }

  /// Rungs down to `last` triangles; the last of them that was not spoiled, or that has more than `at_any_price`: what
  /// cannot be fitted because it is too large would have no rungs below, and have to leave as a whole.
  Mesh run(const Mesh& first, const CollapseOptions& options, std::size_t last,
           std::size_t at_any_price = std::numeric_limits<std::size_t>::max()) {
    Collapser c(first, options);
    Mesh level = first;
    for (std::size_t n = first.n_faces(); n > last;) {
      n = std::max(last, std::min(n - 1, static_cast<std::size_t>(step_ * static_cast<double>(n))));
      const auto before = c.n_faces();
      c.run_to(n);
      if (c.n_faces() >= before || c.n_faces() == 0) break;
      const double held_back = static_cast<double>(c.n_faces()) / static_cast<double>(n);
      n = c.n_faces();
      Mesh next = c.mesh();
      add(next);
      if (level.n_faces() <= at_any_price && (is_spoiled() || held_back > 1.2)) break;
      level = std::move(next);
    }
    return level;
  }

  /// Whether the last rung is so much worse than the one before that a fitted surface has to do better.
  bool is_spoiled() const {
    const double before = rungs_[rungs_.size() - 2].distortion.squares, squares = rungs_.back().distortion.squares;
    if (before > 0 && squares > spoiling * before && rungs_.size() > 3) return true;
    return rungs_.back().n_faces <= most_fitted && squares > spoiling_when_far * before && squares > far_squares_;
  }

  void add(const Mesh& level) {
    const auto triangles = triangles_of(level);
    const ClosestPoint nearest(triangles);
    // As many questions as the level has triangles: its error is spread over its faces.
    const auto some = strided(std::clamp<std::size_t>(4 * level.n_faces(), least_samples, 8000));
    const auto regions = regions_in(level);
    auto d = measure_distortion(triangles, nearest, some, original_, regions, some.size());
    for (std::size_t i = 0; i < triangles.size() && spacing_ > 0; ++i)
      measure_edges(triangles[i], colors_ ? regions[i] : FlatColors::none, 4 * spacing_, original_, d);
    Rung rung{level, 0, d, false};
    if (colors_) colors_->paint(rung.mesh, regions);
    push(std::move(rung));
  }

  void push(Rung rung) {
    drop_faces_without_area(rung.mesh);
    rung.n_faces = rung.mesh.n_faces();
    rungs_.push_back(std::move(rung));
  }

  std::vector<SurfaceSample> strided(std::size_t n) const {
    const std::size_t stride = std::max<std::size_t>(1, samples_.size() / n);
    std::vector<SurfaceSample> out;
    for (std::size_t i = 0; i < samples_.size(); i += stride) {
      out.push_back(samples_[i]);
      out.back().weight *= static_cast<double>(stride);
    }
    return out;
  }

  void fit(PlainMesh coarse) {
    const auto some = strided(std::max(samples_of_face * coarse.faces.size(), least_samples));
    FittedSurface surface(std::move(coarse), original_, some);
    std::size_t next = surface.n_faces() - 1;
    while (surface.n_faces() > 1 && surface.step()) {
      if (surface.n_faces() > next) continue;
      surface.refine(surface.n_faces() < fitted_below ? 2 : 1);
      add(surface);
      const auto n = surface.n_faces();
      const double step = n > fitted_below ? step_ : n > every_below ? std::max(step_, fine_step) : 1;
      next = std::min(n - 1, static_cast<std::size_t>(step * static_cast<double>(n)));
    }
  }

  void add(const FittedSurface& surface) {
    const auto left = surface.mesh();
    Rung rung{{}, 0, surface.distortion(), true};
    rung.mesh.kind = Mesh::Kind::faces;
    auto& positions = rung.mesh.positions.edit();
    for (const Vec3& p : left.positions) positions.insert(positions.end(), p.begin(), p.end());
    for (const auto& f : left.faces) rung.mesh.corners.insert(rung.mesh.corners.end(), f.begin(), f.end());
    if (colors_) colors_->paint(rung.mesh, left.regions);
    rung.mesh.crease_angle = part_.mesh.crease_angle;
    rung.mesh.ccw = part_.mesh.ccw;
    push(std::move(rung));
  }

  const LadderPart& part_;
  std::vector<SurfaceSample> samples_;
  Triangles surface_;
  ClosestPoint nearest_;
  std::optional<FlatColors> colors_;
  std::optional<Mesh> painted_;
  std::optional<ClosestOfLabel> regions_;
  Original original_{surface_, nearest_};
  std::vector<Rung> rungs_;
  double spacing_ = 0;  // of the samples
  double step_ = coarse_step;
  double far_squares_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<Rung> make_ladder(const LadderPart& part) {
  auto rungs = Ladder(part).run();
  std::stable_sort(rungs.begin() + 1, rungs.end(), [](auto& a, auto& b) { return a.n_faces > b.n_faces; });
  // From the coarsest up: a rung that is no nearer than a coarser one goes.
  std::vector<Rung> out;
  for (auto r = rungs.rbegin(); r + 1 != rungs.rend(); ++r)
    if (out.empty() || (r->n_faces > out.back().n_faces && r->distortion.squares < out.back().distortion.squares))
      out.push_back(std::move(*r));
    else if (r->n_faces == out.back().n_faces && r->distortion.squares < out.back().distortion.squares)
      out.back() = std::move(*r);
  out.push_back(std::move(rungs.front()));
  std::ranges::reverse(out);
  return out;
}

std::vector<std::uint32_t> convex_hull(std::span<const Rung> rungs, const Stretch& stretch) {
  std::vector<double> squares;
  for (const auto& r : rungs) squares.push_back(stretch.squares(r.distortion));
  std::vector<std::uint32_t> out;
  auto slope = [&](std::size_t from, std::size_t to) {
    return (squares[to] - squares[from]) / static_cast<double>(rungs[from].n_faces - rungs[to].n_faces);
  };
  for (std::uint32_t i = 0; i < rungs.size(); ++i) {
    while (out.size() > 1 && slope(out[out.size() - 2], i) <= slope(out[out.size() - 2], out.back())) out.pop_back();
    out.push_back(i);
  }
  return out;
}

}  // namespace wrlkit::simplify

#include "geometry/simplify/world.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/parallel.h"
#include "geometry/closest_point.h"
#include "geometry/deviation.h"
#include "geometry/flat_colors.h"
#include "geometry/geometry.h"
#include "geometry/simplify/shared_borders.h"

namespace wrlkit {
namespace {

double area_of(const Mesh& mesh) {
  double area = 0;
  const auto triangles = triangles_of(mesh);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Vec3 n = area_normal(triangles[i]);
    area += std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
  }
  return area;
}

/// How many triangles a surface has left when its error, in the world, has grown to a bound.
class FacesByError {
 public:
  FacesByError(const Mesh& mesh, const CollapseOptions& options, double scale) {
    constexpr double share = 0.97;  // from sample to sample
    const auto painted = with_whole_faces(mesh);
    Collapser c(painted ? *painted : mesh, options);
    samples_.push_back({0, static_cast<double>(mesh.n_faces())});
    for (std::size_t n = mesh.n_faces(); n > faces_of_a_box;) {
      n = std::max(faces_of_a_box, std::min(n - 1, static_cast<std::size_t>(static_cast<double>(n) * share)));
      c.run_to(n);
      if (c.n_faces() > n || c.n_faces() == 0) break;  // no edge may go any more, or the surface would
      n = c.n_faces();
      samples_.push_back({std::max(samples_.back().error, scale * c.error()), static_cast<double>(n)});
    }
  }

  double largest_error() const { return samples_.back().error; }
  double operator()(double error) const {
    auto after = std::ranges::upper_bound(samples_, error, {}, &Sample::error);
    if (after == samples_.end()) return samples_.back().faces;
    if (after == samples_.begin()) return after->faces;
    const auto& before = *std::prev(after);
    const double t = (error - before.error) / (after->error - before.error);
    return before.faces + t * (after->faces - before.faces);
  }

 private:
  struct Sample {
    double error, faces;
  };
  std::vector<Sample> samples_;
};

/// Triangles of each surface at each count: where the same error bounds all of them.
std::vector<std::vector<std::size_t>> share_out(const std::vector<FacesByError>& curves,
                                                const std::vector<std::size_t>& counts) {
  double largest = 0;
  for (const auto& c : curves) largest = std::max(largest, c.largest_error());
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t count : counts) {
    double low = 0, high = largest;
    for (int i = 0; i < 100 && low < high; ++i) {
      const double middle = (low + high) / 2;
      double sum = 0;
      for (const auto& c : curves) sum += std::floor(c(middle));
      (sum > static_cast<double>(count) ? low : high) = middle;
    }
    auto& faces = out.emplace_back();
    for (const auto& c : curves) faces.push_back(static_cast<std::size_t>(c(high)));
  }
  return out;
}

}  // namespace

std::vector<std::size_t> counts_of(const WorldSimplifyOptions& options, std::size_t n) {
  constexpr std::size_t most = 10'000;
  std::vector<std::size_t> out = options.counts;
  if (options.every > 0 && n > 0) {
    auto k = (n - 1) / options.every * options.every;
    for (std::size_t i = 0; k > 0 && i < most; ++i, k -= options.every) out.push_back(k);
  }
  for (double r : options.ratios)
    out.push_back(std::max<std::size_t>(1, static_cast<std::size_t>(r * static_cast<double>(n))));
  std::erase_if(out, [&](std::size_t k) { return k >= n; });
  std::ranges::sort(out, std::greater{});
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

SimplifiedWorld::SimplifiedWorld(const Scene& scene, const WorldSimplifyOptions& options, Task& ctx)
    : scene_(scene), budget_(options.budget) {
  read_parts(options, ctx);
  auto errors = options.errors;
  std::ranges::sort(errors);
  const auto counts = counts_of(options, options.drawn > 0 && n_faces_ > 0 ? options.drawn : n_faces_);
  std::vector<std::vector<std::size_t>> faces;
  if (errors.empty() && parts_.size() > 1) {
    std::vector<std::optional<FacesByError>> curves(parts_.size());
    parallel_for(parts_.size(),
                 [&](std::size_t i) { curves[i].emplace(parts_[i].mesh, parts_[i].collapse, parts_[i].scale); });
    std::vector<FacesByError> all;
    all.reserve(curves.size());
    for (auto& c : curves) all.push_back(std::move(*c));
    faces = share_out(all, counts);
  } else {
    for (std::size_t count : counts) faces.push_back({count});
  }
  const auto n_points = errors.empty() ? counts.size() : errors.size();
  parallel_for(parts_.size(), [&](std::size_t i) {
    auto& p = parts_[i];
    if (!errors.empty()) {
      auto local = errors;
      for (double& e : local) e /= p.scale;
      p.levels = make_levels(p.mesh, {.collapse = p.collapse, .errors = local});
      for (double e : local)
        p.at.push_back(static_cast<std::size_t>(
            std::ranges::count_if(p.levels, [&](const MeshLevel& l) { return l.error <= e; })));
      return;
    }
    LevelMaker maker(p.mesh, p.collapse);
    for (std::size_t k = 0; k < n_points; ++k) {
      if (auto level = maker.next(faces[k][i])) p.levels.push_back(std::move(*level));
      p.at.push_back(p.levels.size());
    }
  });
  measure_points(n_points);
  if (n_points > 0 && points_.empty()) ctx.diag.report(Diag::not_simplified, {}, "no edge may go");
}

void SimplifiedWorld::read_parts(const WorldSimplifyOptions& options, Task& ctx) {
  SurfaceReader reader(scene_, ctx);
  const auto surfaces = surfaces_of(scene_, report_not_simplified(scene_, ctx.diag), BelowLod::leave_levels);
  const auto scales =
      options.expanded ? largest_scales(scene_, *options.expanded, surfaces) : largest_scales(scene_, surfaces);
  SharedBorders borders;
  Mesh mesh;
  std::vector<std::size_t> number;  // of the surface of each part
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    reader.read(surfaces[i], mesh);
    borders.add(mesh);
    if (mesh.n_faces() == 0) continue;
    n_faces_ += mesh.n_faces();
    number.push_back(i);
    const double area = area_of(mesh) * scales[i] * scales[i];
    parts_.push_back({surfaces[i], std::move(mesh), options.collapse, scales[i], area, {}, {}});
  }
  if (std::ranges::none_of(parts_, [](const Part& p) { return p.mesh.n_faces() > faces_of_a_box; })) return;
  auto fixed = borders.find(scene_, surfaces);
  for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i].collapse.fixed = std::move(fixed[number[i]]);
}

void SimplifiedWorld::measure_points(std::size_t n) {
  std::size_t before = n_faces_;
  for (std::size_t k = 0; k < n;) {
    InteractionPoint point;
    double area = 0;
    for (const auto& p : parts_) {
      area += p.area;
      const MeshLevel* level = p.at[k] ? &p.levels[p.at[k] - 1] : nullptr;
      point.n_faces += (level ? level->mesh : p.mesh).n_faces();
      if (!level) continue;
      point.rms += p.area * p.scale * p.scale * level->rms * level->rms;
      point.error = std::max(point.error, p.scale * level->error);
      point.normals += p.area * level->normals;
      point.seconds += level->seconds;
    }
    if (point.n_faces == before) {  // nothing may go within this error, or no more
      for (auto& p : parts_) p.at.erase(p.at.begin() + static_cast<std::ptrdiff_t>(k));
      --n;
      continue;
    }
    before = point.n_faces;
    point.rms = area > 0 ? std::sqrt(point.rms / area) : 0;
    point.normals = area > 0 ? point.normals / area : 0;
    points_.push_back(point);
    ++k;
  }
}

Scene SimplifiedWorld::scene_at(std::size_t i) const {
  Scene out = scene_;
  for (const auto& p : parts_)
    if (p.at[i]) store_mesh(out, p.surface.geometry, p.levels[p.at[i] - 1].mesh);
  return out;
}

Scene SimplifiedWorld::scene_with_levels() const {
  Scene out = scene_;
  LodNodes nodes(out);
  for (const auto& p : parts_) nodes.add(p.surface, p.mesh, p.levels, budget_);
  nodes.replace_shapes();
  return out;
}

}  // namespace wrlkit

#include "geometry/simplify/levels.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "base/text/nearest_name.h"
#include "geometry/deviation.h"
#include "geometry/flat_colors.h"
#include "geometry/triangulation.h"

namespace wrlkit {
namespace {

/// To six decimals of the extent, which no eye can tell and a text file is a third shorter for. Positions that were
/// printed with fewer digits stay as they are, and so do those that neighbours have too.
void round_positions(Mesh& mesh, const std::vector<Vec3>& fixed) {
  const double extent = std::ranges::max(box_of<3>(mesh.positions.span()).size());
  if (!(extent > 0)) return;
  const int exponent = static_cast<int>(std::floor(std::log10(extent))) - 6;
  const double step = std::pow(10.0, std::abs(exponent));
  // Powers of ten below one are not exact: dividing by their reciprocal gives the double that the digits mean.
  auto rounded = [&](double x) { return exponent < 0 ? std::round(x * step) / step : std::round(x / step) * step; };
  auto& p = mesh.positions.edit();
  for (std::size_t i = 0; i < p.size(); i += 3)
    if (fixed.empty() || !std::ranges::binary_search(fixed, Vec3{p[i], p[i + 1], p[i + 2]}))
      for (std::size_t k = i; k < i + 3; ++k) p[k] = rounded(p[k]);
}

MeshLevel measured(const Mesh& first, Mesh mesh, const CollapseOptions& options) {
  std::vector<Vec3> fixed;
  for (auto i : options.fixed) fixed.push_back(triangles_of(first).position(i));
  std::ranges::sort(fixed);
  round_positions(mesh, fixed);
  drop_faces_without_area(mesh);
  auto d = measure_deviation(triangles_of(first), triangles_of(mesh));
  if (const auto colors = FlatColors::of(first)) {
    const auto regions = colors->regions_of(mesh);
    const auto beyond =
        measure_labeled({triangles_of(mesh), regions}, {triangles_of(first), colors->regions()}, colors->n_regions());
    d.max = std::max(d.max, beyond.max);
    d.rms = std::sqrt((d.forward.rms * d.forward.rms + beyond.rms * beyond.rms) / 2);
  }
  return {std::move(mesh), d.rms, d.max, d.normal_mean};
}

/// Processor time of this thread: a collapser has one.
double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

class Levels {
 public:
  Levels(const Mesh& first, const LevelOptions& options)
      : first_(first), painted_(with_whole_faces(first)), options_(options), n_last_(first.n_faces()) {}

  std::vector<MeshLevel> run() {
    if (!options_.errors.empty()) {
      for (double e : options_.errors) add_within(e);
      return std::move(levels_);
    }
    Collapser c(painted_ ? *painted_ : first_, options_.collapse);
    for (double r : options_.ratios) {
      c.run_to(std::max(faces_of_a_box, static_cast<std::size_t>(r * static_cast<double>(first_.n_faces()))));
      if (saves_enough(c.n_faces())) add(measured(first_, c.mesh(), options_.collapse));
    }
    return std::move(levels_);
  }

 private:
  bool saves_enough(std::size_t n) const {
    return n > 0 && static_cast<double>(n) <= (1 - options_.min_saving) * static_cast<double>(n_last_) && n < n_last_;
  }

  void add(MeshLevel level) {
    while (!levels_.empty() && levels_.back().error >= level.error) levels_.pop_back();
    n_last_ = level.mesh.n_faces();
    levels_.push_back(std::move(level));
  }

  /// The collapser's own error is an estimate; what it leads to is measured, and the estimate moved until it fits.
  void add_within(double error) {
    constexpr int tries = 6;
    std::optional<MeshLevel> best;
    double estimate = error, low = 0, high = std::numeric_limits<double>::infinity();
    for (int i = 0; i < tries; ++i) {
      Collapser c(painted_ ? *painted_ : first_, options_.collapse);
      c.run_to(faces_of_a_box, estimate);
      auto level = measured(first_, c.mesh(), options_.collapse);
      const bool fits = level.error <= error;
      (fits ? low : high) = estimate;
      if (fits && (!best || level.mesh.n_faces() < best->mesh.n_faces())) best = std::move(level);
      if (c.n_faces() <= faces_of_a_box && fits) break;
      estimate = std::isfinite(high) ? (low + high) / 2 : 2 * estimate;
    }
    if (best && saves_enough(best->mesh.n_faces())) add(std::move(*best));
  }

  const Mesh& first_;
  const std::optional<Mesh> painted_;
  const LevelOptions& options_;
  std::size_t n_last_;
  std::vector<MeshLevel> levels_;
};

}  // namespace

bool CriterionName::read(std::string_view text) {
  for (Criterion c : all_criteria())
    if (info(c).name == text && info(c).missing.empty()) {
      value = c;
      return true;
    }
  return false;
}

std::string CriterionName::print() const { return info(value).name; }

std::string CriterionName::fault(std::string_view text) {
  NearestName nearest(text);
  for (Criterion c : all_criteria()) {
    nearest.consider(info(c).name);
    if (info(c).name == text)
      return info(c).missing.empty() ? ""
                                     : "'" + std::string(text) + "' needs " + std::string(info(c).missing) +
                                           ", which this wrlkit was built without";
  }
  return "'" + std::string(text) + "' is not a valid value: " + help() + nearest.question();
}

std::string CriterionName::help() {
  std::string text;
  for (Criterion c : all_criteria()) {
    if (!text.empty()) text += c == all_criteria().back() ? " or " : ", ";
    text += info(c).name;
  }
  return text;
}

std::vector<std::string> criterion_names() {
  std::vector<std::string> names;
  for (Criterion c : all_criteria())
    if (info(c).missing.empty()) names.push_back(info(c).name);
  return names;
}

LevelMaker::LevelMaker(const Mesh& first, const CollapseOptions& options)
    : first_(first),
      painted_(with_whole_faces(first)),
      options_(options),
      seconds_(-thread_seconds()),
      collapser_(painted_ ? *painted_ : first, options) {
  seconds_ += thread_seconds();
}

std::optional<MeshLevel> LevelMaker::next(std::size_t n_faces) {
  const auto before = collapser_.n_faces();
  seconds_ -= thread_seconds();
  collapser_.run_to(n_faces);
  seconds_ += thread_seconds();
  if (collapser_.n_faces() >= before || collapser_.n_faces() == 0) return std::nullopt;
  auto level = measured(first_, collapser_.mesh(), options_);
  level.seconds = seconds_;
  return level;
}

std::vector<MeshLevel> make_levels(const Mesh& first, const LevelOptions& options) {
  return Levels(first, options).run();
}

}  // namespace wrlkit

// Samples and corners are asked in runs of fixed length, whose sums are added in order: the figures do not depend on
// the number of threads. Within a run each answer is the guess for the next question.
#include "geometry/deviation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <optional>

#include "base/hashing.h"
#include "base/math/vec.h"
#include "base/parallel.h"
#include "geometry/closest_of_label.h"

namespace wrlkit {
namespace {

constexpr std::size_t run_length = 2048;
constexpr std::size_t tries_per_question = 200;  // triangles, in the mean of a run
constexpr std::size_t fewest_samples = 500, most_samples = 400'000, samples_per_triangle = 4;

using Marks = std::vector<char>;  // of triangles

struct Key {
  std::uint64_t hash;
  std::uint32_t triangle;
};

/// Corners, the least one first.
std::array<Vec3, 3> turned(std::array<Vec3, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// The triangles of a surface by their corners.
std::vector<Key> sorted_keys(const Triangles& surface) {
  std::vector<Key> keys;
  keys.reserve(surface.size());
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    std::uint64_t h = 0;
    for (const Vec3& p : turned(surface[t]))
      for (double v : p) h = mixed(h, std::bit_cast<std::uint64_t>(v + 0.0));  // -0 is 0
    keys.push_back({h, t});
  }
  std::ranges::sort(keys, {}, &Key::hash);
  return keys;
}

constexpr std::uint32_t no_twin = 0xffffffffu;

/// For each triangle of `a` that of `b` with the same corners, in the same sense. Of those with equal hashes one is
/// looked at; should it be another one by chance, a triangle counts as changed that is not. They are looked at in the
/// order of the surface and not of the hashes, where each would be far from the one before.
std::vector<std::uint32_t> twins_in(const Triangles& a, const std::vector<Key>& keys_a, const Triangles& b,
                                    const std::vector<Key>& keys_b) {
  std::vector<std::uint32_t> twin(a.size(), no_twin);
  auto other = keys_b.begin();
  for (const Key& k : keys_a) {
    while (other != keys_b.end() && other->hash < k.hash) ++other;
    if (other == keys_b.end()) break;
    if (other->hash == k.hash) twin[k.triangle] = other->triangle;
  }
  for (std::size_t t = 0; t < twin.size(); ++t)
    if (twin[t] != no_twin && turned(a[t]) != turned(b[twin[t]])) twin[t] = no_twin;
  return twin;
}

/// Which triangles of `a` are in `b`, too.
Marks also_in(const Triangles& a, const std::vector<Key>& keys_a, const Triangles& b, const std::vector<Key>& keys_b) {
  const auto twins = twins_in(a, keys_a, b, keys_b);
  Marks marks(twins.size());
  std::ranges::transform(twins, marks.begin(), [](std::uint32_t twin) { return twin != no_twin; });
  return marks;
}

/// What was found at some points.
struct Sums {
  std::size_t n = 0, n_normals = 0;
  std::size_t n_tried = 0;
  double squares = 0, max = 0, angles = 0, squared_angles = 0, max_angle = 0;
  Vec3 where{};

  void add_distance(const ClosestPoint::Nearest& found, const Vec3& p) {
    double d = found.distance;
    if (!n++ || d > max) {
      max = d;
      where = p;
    }
    squares += d * d;
    n_tried += found.n_tried;
  }
  /// Large triangles through one another, thousands of them, defeat a tree: each question looks at all. Then a run ends
  /// before all its points were asked.
  bool too_costly() const { return n_tried > run_length * tries_per_question; }
  void add_angle(double a) {
    ++n_normals;
    angles += a;
    squared_angles += a * a;
    max_angle = std::max(max_angle, a);
  }
  void add(const Sums& s) {
    if (!n || s.max > max) {
      max = s.max;
      where = s.where;
    }
    n += s.n;
    n_normals += s.n_normals;
    squares += s.squares;
    angles += s.angles;
    squared_angles += s.squared_angles;
    max_angle = std::max(max_angle, s.max_angle);
  }
};

/// Adds up `sums_of(begin, end)` over all runs of [0, n).
Sums in_runs(std::size_t n, const std::function<Sums(std::size_t, std::size_t)>& sums_of) {
  if (n <= run_length) return sums_of(0, n);
  std::vector<Sums> parts((n + run_length - 1) / run_length);
  parallel_for(parts.size(),
               [&](std::size_t i) { parts[i] = sums_of(i * run_length, std::min(n, (i + 1) * run_length)); });
  Sums all;
  for (const Sums& s : parts) all.add(s);
  return all;
}

/// Labels of the triangles of both surfaces; none at all: all that a surface has is near to all of the other.
struct Labels {
  std::span<const std::uint32_t> from, to;
  std::uint32_t n = 0;

  bool present() const { return n > 0; }
};

/// The other surface, or of it what has the label of the triangle that asks.
class Target {
 public:
  Target(const Triangles& to, const Labels& labels) : labels_(labels) {
    if (labels.present())
      of_label_.emplace(to, labels.to, labels.n);
    else
      all_.emplace(to);
  }

  ClosestPoint::Nearest nearest(const Vec3& p, const Vec3& facing, std::uint32_t from, std::uint32_t guess) const {
    if (all_) return all_->nearest(p, facing, guess);
    return of_label_->nearest(p, facing, labels_.from[from], guess);
  }

 private:
  Labels labels_;
  std::optional<ClosestPoint> all_;
  std::optional<ClosestOfLabel> of_label_;
};

/// One way: from the changed triangles of a surface to the other one.
class Way {
 public:
  Way(const Triangles& from, const Marks& unchanged, const Triangles& to, const Labels& labels = {})
      : from_(from), to_(to), labels_(labels) {
    for (std::uint32_t t = 0; t < from.size(); ++t) {
      auto corners = from[t];
      if (!is_usable(corners)) continue;
      double area = length(area_normal(corners)) / 2;
      all_area_ += area;
      if (unchanged[t] || (labels.present() && labels.from[t] >= labels.n)) continue;
      changed_.push_back(t);
      area_.push_back(changed_area_ += area);
    }
  }

  OneSidedDeviation measure(std::size_t n_samples) {
    if (changed_.empty()) return {};
    nearest_.emplace(to_, labels_);
    auto points = corners();
    Sums at_corners = in_runs(points.size(), [&](auto begin, auto end) {
      return ask_corners({points.data() + begin, end - begin});
    });
    Sums means = at_corners, all = at_corners;
    double part = 1;
    if (changed_area_ > 0) {
      means = in_runs(n_samples, [&](auto begin, auto end) { return ask_samples(begin, end, n_samples); });
      all.add(means);
      part = changed_area_ / all_area_;
    }
    auto mean = [part](double sum, std::size_t n) { return n ? part * sum / static_cast<double>(n) : 0; };
    return {std::sqrt(mean(means.squares, means.n)),
            all.max,
            all.where,
            mean(means.angles, means.n_normals),
            std::sqrt(mean(means.squared_angles, means.n_normals)),
            means.max_angle};
  }

 private:
  struct Corner {
    std::uint32_t position, triangle;
  };

  std::uint32_t label_of(const Corner& corner) const { return labels_.present() ? labels_.from[corner.triangle] : 0; }

  /// Positions of changed triangles, each once for each label.
  std::vector<Corner> corners() const {
    std::vector<Corner> out;
    out.reserve(changed_.size() * 3);
    for (auto t : changed_)
      for (std::size_t k = 0; k < 3; ++k) out.push_back({from_.corners[t * std::size_t{3} + k], t});
    const auto key = [&](const Corner& c) { return std::pair(c.position, label_of(c)); };
    std::ranges::sort(out, {}, key);
    const auto same = [&](const Corner& a, const Corner& b) { return key(a) == key(b); };
    out.erase(std::unique(out.begin(), out.end(), same), out.end());
    return out;
  }

  Sums ask_corners(std::span<const Corner> corners) const {
    Sums sums;
    auto guess = ClosestPoint::no_guess;
    for (const Corner& c : corners) {
      Vec3 point = from_.position(c.position);
      auto found = nearest_->nearest(point, {}, c.triangle, guess);
      sums.add_distance(found, point);
      guess = found.triangle;
      if (sums.too_costly()) break;
    }
    return sums;
  }

  /// A point of a triangle of `from_`, and how far it is from the other surface.
  struct Sample {
    std::uint32_t triangle = 0, nearest = ClosestPoint::no_guess;
    double u = 0, v = 0, distance = -1;
  };

  static Vec3 point_at(const std::array<Vec3, 3>& t, double u, double v) {
    return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
  }

  /// Equal steps through the area, and in each triangle the additive sequence of the plastic number, which fills the
  /// square evenly; the square is folded to a triangle.
  Sums ask_samples(std::size_t begin, std::size_t end, std::size_t n) const {
    constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
    auto fraction = [](double x) { return x - std::floor(x); };
    const double spacing = changed_area_ / static_cast<double>(n);
    auto slot = static_cast<std::size_t>(
        std::upper_bound(area_.begin(), area_.end(), (static_cast<double>(begin) + 0.5) * spacing) - area_.begin());
    Sums sums;
    Sample sample, worst;
    for (std::size_t k = begin; k < end; ++k) {
      const auto number = static_cast<double>(k);
      while (slot + 1 < area_.size() && area_[slot] <= (number + 0.5) * spacing) ++slot;
      sample.triangle = changed_[slot];
      sample.u = fraction(number * step_u);
      sample.v = fraction(number * step_v);
      if (sample.u + sample.v > 1) {
        sample.u = 1 - sample.u;
        sample.v = 1 - sample.v;
      }
      ask(sample, sums);
      if (sample.distance > worst.distance) worst = sample;
      if (sums.too_costly()) return sums;
    }
    climb(worst, spacing, sums);
    return sums;
  }

  void ask(Sample& s, Sums& sums) const {
    auto t = from_[s.triangle];
    Vec3 normal = unit(area_normal(t)), p = point_at(t, s.u, s.v);
    auto found = nearest_->nearest(p, normal, s.triangle, s.nearest);
    s.distance = found.distance;
    s.nearest = found.triangle;
    sums.add_distance(found, p);
    if (s.nearest == ClosestPoint::no_guess) return;
    Vec3 there = area_normal(to_[s.nearest]);
    if (there != Vec3{0, 0, 0}) sums.add_angle(std::atan2(length(cross(normal, there)), dot(normal, there)));
  }

  /// The largest distance usually lies between samples: uphill from the worst one within its triangle, by steps that
  /// are halved when none of the six ways leads up.
  void climb(Sample at, double spacing, Sums& sums) const {
    constexpr double ways[6][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
    auto t = from_[at.triangle];
    double step = std::min(0.5, std::sqrt(2 * spacing / length(area_normal(t))));
    for (int halvings = 0, moves = 0; halvings < 8 && moves < 16;) {
      bool up = false;
      for (auto& w : ways) {
        double u = at.u + step * w[0], v = at.v + step * w[1];
        if (u < 0 || v < 0 || u + v > 1) continue;
        double d = nearest_->nearest(point_at(t, u, v), {}, at.triangle, at.nearest).distance;
        if (d > at.distance) {
          at.u = u;
          at.v = v;
          at.distance = d;
          up = true;
        }
      }
      if (up)
        ++moves;
      else {
        ++halvings;
        step /= 2;
      }
    }
    if (at.distance > sums.max) {
      sums.max = at.distance;
      sums.where = point_at(t, at.u, at.v);
    }
  }

  const Triangles &from_, &to_;
  Labels labels_;
  std::optional<Target> nearest_;
  std::vector<std::uint32_t> changed_;
  std::vector<double> area_;  // of the changed triangles up to each, and with it
  double changed_area_ = 0, all_area_ = 0;
};

std::size_t number_of_samples(const Triangles& a, const Triangles& b, const DeviationOptions& options) {
  if (options.samples) return options.samples;
  return std::clamp((a.size() + b.size()) * samples_per_triangle, fewest_samples, most_samples);
}

Deviation both(const OneSidedDeviation& a, const OneSidedDeviation& b) {
  auto root_mean = [](double x, double y) { return std::sqrt((x * x + y * y) / 2); };
  const OneSidedDeviation& worse = b.max > a.max ? b : a;
  Deviation out;
  static_cast<OneSidedDeviation&>(out) = {root_mean(a.rms, b.rms),
                                          worse.max,
                                          worse.where,
                                          (a.normal_mean + b.normal_mean) / 2,
                                          root_mean(a.normal_rms, b.normal_rms),
                                          std::max(a.normal_max, b.normal_max)};
  out.forward = a;
  out.backward = b;
  return out;
}

}  // namespace

Deviation measure_deviation(const Triangles& a, const Triangles& b, const DeviationOptions& options) {
  Marks in_b, in_a;
  {
    auto keys_a = sorted_keys(a), keys_b = sorted_keys(b);
    in_b = also_in(a, keys_a, b, keys_b);
    in_a = also_in(b, keys_b, a, keys_a);
  }
  const std::size_t n = number_of_samples(a, b, options);
  auto forward = Way(a, in_b, b).measure(n);
  return both(forward, Way(b, in_a, a).measure(n));
}

OneSidedDeviation measure_labeled(const LabeledTriangles& from, const LabeledTriangles& to, std::uint32_t n_labels) {
  const auto keys_from = sorted_keys(from.surface), keys_to = sorted_keys(to.surface);
  const auto twins = twins_in(from.surface, keys_from, to.surface, keys_to);
  Marks unchanged(twins.size());
  for (std::size_t t = 0; t < twins.size(); ++t)
    unchanged[t] = twins[t] != no_twin && from.labels[t] == to.labels[twins[t]];
  const Labels labels{from.labels, to.labels, n_labels};
  return Way(from.surface, unchanged, to.surface, labels).measure(number_of_samples(from.surface, to.surface, {}));
}

}  // namespace wrlkit

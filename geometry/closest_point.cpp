// The tree is split by the surface area heuristic over a few bins along the longest side of the centres. Boxes are
// single precision, rounded outwards and relative to the middle of the surface; all distances are double.
#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/box.h"
#include "base/math/vec.h"
#include "base/parallel.h"

namespace wrlkit {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr std::uint32_t large = 100'000;  // triangles that are worth another thread
constexpr int n_bins = 12;
constexpr int balanced_below = 40;  // depth from which triangles are halved by number, so that the tree ends
constexpr int most_depth = balanced_below + 32;
constexpr std::uint32_t most_tried = 20'000;  // triangles among those with labels
constexpr int most_equal = 32;  // triangles compared for where they face; there may be thousands in one place
constexpr double largest = 1e18;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double flat = 1e-24;  // squared sine below which a triangle is its edges

double squared(const Vec3& v) { return dot(v, v); }

/// As area_normal, which others could replace, so that compilers do not inline it.
Vec3 normal_of(const std::array<Vec3, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// Whether the plane of a triangle with this area normal is farther from the origin than the root of `reach`. Of thin
/// ones, whose planes rounding turns, that is not known.
bool is_beyond(const std::array<Vec3, 3>& t, const Vec3& n, double reach) {
  constexpr double thin = 1e-8, rounding = 1 + 1e-6;
  const double height = dot(t[0], n), nn = squared(n);
  return height * height > rounding * reach * nn && nn > thin * squared(t[1] - t[0]) * squared(t[2] - t[0]);
}

/// Squared distance of the origin to the segment from a to b.
double to_segment(const Vec3& a, const Vec3& b) {
  Vec3 ab = b - a;
  double along = -dot(a, ab), all = squared(ab);
  if (!(along > 0)) return squared(a);
  return along < all ? squared(a + (along / all) * ab) : squared(b);
}

/// Squared distance of the origin to a triangle with this area normal. Whoever is beyond an edge is nearest to one of
/// the edges that he is beyond. The foot is a mean of the corners, so it is on the triangle however thin that is.
double to_triangle(const std::array<Vec3, 3>& t, const Vec3& n) {
  Vec3 ab = t[1] - t[0], ac = t[2] - t[0];
  double nn = squared(n), least = infinity;
  if (!(nn > flat * squared(ab) * squared(ac)))
    return std::min({to_segment(t[0], t[1]), to_segment(t[1], t[2]), to_segment(t[2], t[0])});
  double weight[3];
  for (int i = 0; i < 3; ++i) {
    const Vec3 &b = t[static_cast<std::size_t>((i + 1) % 3)], &c = t[static_cast<std::size_t>((i + 2) % 3)];
    weight[i] = dot(cross(b, c), n);
    if (weight[i] < 0) least = std::min(least, to_segment(b, c));
  }
  if (least < infinity) return least;
  return squared((1 / (weight[0] + weight[1] + weight[2])) * (weight[0] * t[0] + weight[1] * t[1] + weight[2] * t[2]));
}

struct Range : BoxOf<float, 3> {
  double half_area() const {
    double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
  }
};

}  // namespace

Triangles triangles_of(const Mesh& mesh) {
  if (!mesh.is_triangles()) return {};
  return {mesh.positions.span(), mesh.corners};
}

Vec3 area_normal(const std::array<Vec3, 3>& t) { return normal_of(t); }

double squared_distance(const Vec3& p, const std::array<Vec3, 3>& corners) {
  const std::array<Vec3, 3> t{corners[0] - p, corners[1] - p, corners[2] - p};
  return to_triangle(t, normal_of(t));
}

bool is_usable(const std::array<Vec3, 3>& corners) {
  for (const Vec3& p : corners)
    for (double v : p)
      if (!(std::fabs(v) < largest)) return false;
  return true;
}

/// Makes the tree; holds what that needs but the result does not.
struct ClosestPoint::Builder {
  struct Item {
    Range range;
    std::uint32_t triangle;
    float middle(std::size_t axis) const { return range.low[axis] + range.high[axis]; }  // doubled
  };
  struct Bin {
    Range range;
    std::uint32_t n = 0;
  };

  ClosestPoint& tree;
  std::span<Item> items;

  void run() {
    tree.order_.reserve(items.size());
    tree.boxes_.reserve(items.size() / 2 + 1);
    if (!items.empty()) split(0, static_cast<std::uint32_t>(items.size()), 0);
  }

  /// Both halves of a box at once, each as a tree of its own, which are put behind one another.
  void split_halves(std::size_t box_of_both, const std::array<std::uint32_t, 3>& ends, int depth) {
    ClosestPoint halves[] = {ClosestPoint(Triangles{}), ClosestPoint(Triangles{})};
    parallel_for(2, [&](std::size_t i) {
      Builder half{halves[i], items};
      half.split(ends[i], ends[i + 1], depth);
    });
    for (const auto& half : halves) {
      const auto n_boxes = static_cast<std::uint32_t>(tree.boxes_.size());
      const auto n_triangles = static_cast<std::uint32_t>(tree.order_.size());
      tree.boxes_[box_of_both].next = n_boxes;
      for (Box box : half.boxes_) {
        box.next += box.n_triangles ? n_triangles : n_boxes;
        tree.boxes_.push_back(box);
      }
      tree.order_.insert(tree.order_.end(), half.order_.begin(), half.order_.end());
    }
  }

  static void list(ClosestPoint& tree, std::vector<Item>& items) {
    wrlkit::Box box;
    for (std::size_t t = 0; t < tree.surface_.size(); ++t) {
      auto corners = tree.surface_[t];
      if (!is_usable(corners)) continue;
      items.push_back({{}, static_cast<std::uint32_t>(t)});
      for (auto& p : corners) box.add(p);
    }
    if (items.empty()) return;
    tree.centre_ = box.centre();
    tree.same_ = 1e-10 * diagonal(box);
    for (Item& item : items)
      for (auto& p : tree.surface_[item.triangle]) item.range.unite(around(p - tree.centre_));
  }

  static Range around(const Vec3& p) {
    Range r;
    for (std::size_t i = 0; i < 3; ++i) {
      auto v = static_cast<float>(p[i]);
      float rounding = std::fabs(v) * 2e-7f + 1e-37f;
      r.low[i] = v - rounding;
      r.high[i] = v + rounding;
    }
    return r;
  }

  void split(std::uint32_t begin, std::uint32_t end, int depth) {
    Range all, middles;
    for (auto i = begin; i < end; ++i) {
      all.unite(items[i].range);
      std::array<float, 3> m{items[i].middle(0), items[i].middle(1), items[i].middle(2)};
      middles.add(m);
    }
    std::size_t here = tree.boxes_.size();
    tree.boxes_.push_back({all.low, all.high, static_cast<std::uint32_t>(tree.order_.size()), end - begin});
    if (end - begin <= leaf_size) {
      for (auto i = begin; i < end; ++i) tree.order_.push_back(items[i].triangle);
      return;
    }
    std::uint32_t middle = partition(begin, end, middles, depth);
    if (end - begin > large) {
      tree.boxes_[here].n_triangles = 0;
      return split_halves(here, {begin, middle, end}, depth + 1);
    }
    split(begin, middle, depth + 1);
    tree.boxes_[here].next = static_cast<std::uint32_t>(tree.boxes_.size());
    tree.boxes_[here].n_triangles = 0;
    split(middle, end, depth + 1);
  }

  /// Where the second half begins; both have something.
  std::uint32_t partition(std::uint32_t begin, std::uint32_t end, const Range& middles, int depth) {
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (middles.high[i] - middles.low[i] > middles.high[axis] - middles.low[axis]) axis = i;
    const float low = middles.low[axis], extent = middles.high[axis] - low;
    auto halfway = begin + (end - begin) / 2;
    auto first = items.begin() + begin, last = items.begin() + end;
    if (!(extent > 0)) return halfway;
    if (depth >= balanced_below) {
      std::nth_element(first, items.begin() + halfway, last,
                       [&](auto& a, auto& b) { return a.middle(axis) < b.middle(axis); });
      return halfway;
    }
    const double bins_a_unit = n_bins / static_cast<double>(extent);
    auto bin_of = [&](const Item& i) {
      return std::min(n_bins - 1, static_cast<int>((i.middle(axis) - low) * bins_a_unit));
    };
    Bin bins[n_bins];
    for (auto i = first; i != last; ++i) {
      Bin& b = bins[bin_of(*i)];
      b.range.unite(i->range);
      ++b.n;
    }
    int cut = cheapest_cut(bins);
    return static_cast<std::uint32_t>(std::partition(first, last, [&](auto& i) { return bin_of(i) < cut; }) -
                                      items.begin());
  }

  /// The first bin of the second half: the least sum of area times number. The first bin and the last are never empty.
  static int cheapest_cut(const Bin (&bins)[n_bins]) {
    double cost[n_bins] = {};
    Range before, after;
    std::uint32_t n_before = 0, n_after = 0;
    for (int i = 1; i < n_bins; ++i) {
      before.unite(bins[i - 1].range);
      n_before += bins[i - 1].n;
      after.unite(bins[n_bins - i].range);
      n_after += bins[n_bins - i].n;
      cost[i] += before.half_area() * n_before;
      cost[n_bins - i] += after.half_area() * n_after;
    }
    return static_cast<int>(std::min_element(cost + 1, cost + n_bins) - cost);
  }
};

ClosestPoint::ClosestPoint(Triangles surface) : surface_(surface) {
  std::vector<Builder::Item> items;
  Builder::list(*this, items);
  Builder{*this, items}.run();
}

ClosestPoint::ClosestPoint(Triangles surface, std::span<const std::uint32_t> labels) : ClosestPoint(surface) {
  labels_ = labels;
  box_labels_.resize(boxes_.size());
  parent_.resize(boxes_.size(), none);
  leaf_of_.resize(surface.size(), none);
  for (auto i = static_cast<std::uint32_t>(boxes_.size()); i-- > 0;) {  // children lie behind their parents
    const Box& box = boxes_[i];
    box_labels_[i] = labels_in(i);
    if (box.n_triangles == 0) parent_[i + 1] = parent_[box.next] = i;
    for (auto k = box.next; k < box.next + box.n_triangles; ++k) leaf_of_[order_[k]] = i;
  }
}

ClosestPoint::Labels ClosestPoint::labels_in(std::uint32_t i) const {
  const Box& box = boxes_[i];
  Labels out;
  if (box.n_triangles == 0) {
    out = box_labels_[i + 1];
    out.add(box_labels_[box.next]);
  }
  for (auto k = box.next; k < box.next + box.n_triangles; ++k) out.add({labels_[order_[k]], labels_[order_[k]]});
  return out;
}

/// A leaf that has nothing left keeps one triangle and no labels.
void ClosestPoint::forget(std::uint32_t first, std::uint32_t end) {
  const auto begin = std::ranges::lower_bound(labels_, first) - labels_.begin();
  for (auto t = static_cast<std::size_t>(begin); t < labels_.size() && labels_[t] < end; ++t) {
    auto at = leaf_of_[t];
    if (at == none) continue;
    Box& leaf = boxes_[at];
    const auto triangles = std::span(order_).subspan(leaf.next, leaf.n_triangles);
    std::swap(*std::ranges::find(triangles, static_cast<std::uint32_t>(t)), triangles.back());
    leaf_of_[t] = none;
    if (leaf.n_triangles > 1) --leaf.n_triangles;
    auto labels = triangles.size() > 1 ? labels_in(at) : Labels{};
    while (labels != box_labels_[at]) {
      box_labels_[at] = labels;
      at = parent_[at];
      if (at == none) break;
      labels = labels_in(at);
    }
  }
}

/// One question on its way down the tree.
struct ClosestPoint::Search {
  const ClosestPoint& tree;
  const Vec3& p;
  const Vec3& facing;
  const bool faces_something = facing != Vec3{};
  Nearest best{infinity, no_guess};
  double reach = infinity;  // squared distance up to which a triangle may be the answer
  double best_facing = -infinity;
  int n_equal = 0;
  double enough = -1;                // distance below which no better answer is wanted
  const Counting* counts = nullptr;  // null: all of them

  void try_triangle(std::uint32_t triangle) {
    if (counts && !(*counts)(tree.labels_[triangle])) return;
    ++best.n_tried;
    auto t = tree.surface_[triangle];
    for (auto& corner : t) corner = corner - p;
    const Vec3 n = normal_of(t);
    if (is_beyond(t, n, reach)) return;
    const double d2 = to_triangle(t, n);
    if (!(d2 <= reach)) return;
    double d = std::sqrt(d2), front = faces_something ? turned_to(n) : 0;
    n_equal = d < best.distance - tree.same_ ? 0 : n_equal + 1;
    if (!n_equal || front > best_facing) {
      best.triangle = triangle;
      best_facing = front;
    }
    best.distance = std::min(best.distance, d);
    double limit = best.distance + (n_equal < most_equal ? tree.same_ : -tree.same_);
    reach = limit < 0 ? -1 : limit * limit;
  }

  double turned_to(const Vec3& n) const {
    const double size = length(n);
    return size > 0 ? dot(n, facing) / size : -infinity;
  }

  bool may_count(std::uint32_t box) const {
    if (!counts) return true;
    const auto [least, most] = tree.box_labels_[box];
    return least <= most && (least < counts->first || most >= counts->end);
  }

  /// Squared distance to a box.
  double to(const Box& box, const Vec3& q) const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double below = box.low[i] - q[i], above = q[i] - box.high[i];
      const double outside = below > above ? below : above, d = outside > 0 ? outside : 0;
      sum += d * d;
    }
    return sum;
  }

  void run() {
    struct Open {
      std::uint32_t box;
      double distance;
    } open[most_depth];
    int n_open = 0;
    const Vec3 q = p - tree.centre_;
    std::uint32_t at = 0;
    for (double distance = to(tree.boxes_[0], q);;) {
      const Box& box = tree.boxes_[at];
      const bool may_be_here = distance <= reach && may_count(at);
      if (may_be_here && !box.n_triangles) {
        std::uint32_t near = at + 1, far = box.next;
        double to_near = to(tree.boxes_[near], q), to_far = to(tree.boxes_[far], q);
        if (to_far < to_near) {
          std::swap(near, far);
          std::swap(to_near, to_far);
        }
        if (to_far <= reach) open[n_open++] = {far, to_far};
        at = near;
        distance = to_near;
        continue;
      }
      if (may_be_here)
        for (auto i = box.next; i < box.next + box.n_triangles; ++i) try_triangle(tree.order_[i]);
      if (!n_open || (counts && best.n_tried > most_tried) || best.distance <= enough) return;
      --n_open;
      at = open[n_open].box;
      distance = open[n_open].distance;
    }
  }
};

ClosestPoint::Nearest ClosestPoint::nearest(const Vec3& p, const Vec3& facing, std::uint32_t guess,
                                            double enough) const {
  Search search{*this, p, facing};
  search.enough = enough;
  if (boxes_.empty()) return search.best;
  if (guess != no_guess) search.try_triangle(guess);
  if (!(search.best.distance <= enough)) search.run();
  return search.best;
}

ClosestPoint::Nearest ClosestPoint::nearest_of(const Vec3& p, double within, const Counting& counts,
                                               std::uint32_t guess) const {
  const Vec3 facing{};
  Search search{*this, p, facing};
  search.reach = within * within;
  search.counts = &counts;
  if (boxes_.empty()) return search.best;
  if (guess != no_guess) search.try_triangle(guess);
  search.run();
  return search.best;
}

}  // namespace wrlkit

#include "geometry/simplify/fitted_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/math/vec.h"
#include "geometry/simplify/closest_on_triangle.h"

namespace wrlkit::simplify {
namespace {

constexpr std::size_t most_asked = 48;        // samples that a price is made of
constexpr std::size_t few_fitted_faces = 32;  // which are asked one by one
constexpr std::size_t most_removable = 256;   // faces from which on none is taken out by itself
constexpr double worth_asking_again = 0.9;    // share of the faces that are left since all were asked
constexpr double most_asked_back = 64;        // points of a face
constexpr double most_reach = 4;              // of a vertex, times the root of the mean square
// Of the four parts of a triangle, as steps along two of its edges; the second is that of the triangle.
constexpr std::array<double, 2> middles[] = {{1. / 6, 1. / 6}, {1. / 3, 1. / 3}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}};

}  // namespace

FittedSurface::FittedSurface(PlainMesh mesh, const Original& original, std::span<const SurfaceSample> samples)
    : original_(original),
      samples_(samples),
      position_(std::move(mesh.positions)),
      face_(std::move(mesh.faces)),
      region_(std::move(mesh.regions)),
      alive_(face_.size(), 1),
      backward_(face_.size()),
      faces_of_(position_.size()),
      samples_of_(face_.size()),
      squared_(samples.size()),
      face_stamp_(face_.size()) {
  double area = 0;
  for (const auto& s : samples_) area += s.weight;
  spacing_ = std::sqrt(area / static_cast<double>(std::max<std::size_t>(samples_.size(), 1)));
  list_faces();
  assign_all();
  measure_backward();
  enqueue_all();
}

void FittedSurface::enqueue_all() {
  n_enqueued_ = n_faces_;
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    if (!alive_[f]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto u = face_[f][k], v = face_[f][(k + 1) % 3];
      const auto& others = faces_of_[u];
      const bool first = std::ranges::none_of(
          others, [&](std::uint32_t o) { return o < f && std::ranges::find(face_[o], v) != face_[o].end(); });
      if (first) enqueue_edge(u, v);
    }
    if (n_faces_ <= most_removable) enqueue_face(f);
  }
}

void FittedSurface::list_faces() {
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    const auto [a, b, c] = face_[f];
    alive_[f] = a != b && b != c && c != a;
    if (!alive_[f]) continue;
    ++n_faces_;
    for (auto v : face_[f]) faces_of_[v].push_back(f);
  }
}

double FittedSurface::cost_of(std::uint32_t sample, double squared) const {
  return samples_[sample].weight * std::min(squared, samples_[sample].enough);
}

/// Of all samples to all faces again.
void FittedSurface::assign_again() {
  if (n_faces_ > few_fitted_faces) return assign_all();
  std::vector<std::uint32_t> faces, samples;
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    if (!alive_[f]) continue;
    faces.push_back(f);
    samples.insert(samples.end(), samples_of_[f].begin(), samples_of_[f].end());
    samples_of_[f].clear();
  }
  assign(samples, faces);
}

void FittedSurface::measure_backward() {
  backward_all_ = {};
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    if (!alive_[f]) continue;
    backward_[f] = backward(corners_of(face_[f], none, {}), region_of(f), &backward_all_);
    measure_edges(corners_of(face_[f], none, {}), region_of(f), 2 * spacing_, original_, backward_all_);
  }
  double area = 0, squares = backward_all_.squares;
  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    area += samples_[s].weight;
    squares += cost_of(s, squared_[s]);
  }
  reach_ = std::max(spacing_, most_reach * std::sqrt(squares / (2 * area)));
}

/// A thin face may have all its samples at one end: where the other end goes costs nothing, but it would be seen.
Vec3 FittedSurface::within_reach(const Vec3& x) const {
  const auto found = original_.nearest.nearest(x, {}, guess_);
  if (found.triangle == ClosestPoint::no_guess || found.distance <= reach_) return x;
  guess_ = found.triangle;
  return x + (1 - reach_ / found.distance) * way_to(x, original_.surface[found.triangle]);
}

/// With `v` at `x`.
std::array<Vec3, 3> FittedSurface::corners_of(const Face& f, std::uint32_t v, const Vec3& x) const {
  std::array<Vec3, 3> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = f[k] == v ? x : position_[f[k]];
  return out;
}

/// The integral of the squared distance from a face to the original, by the middles of equal parts of it, or where they
/// are many, by points that are spread evenly: a face across a notch has to be found out.
double FittedSurface::backward(const std::array<Vec3, 3>& c, std::uint32_t region, Distortion* all) const {
  const double area = fast_length(area_normal(c)) / 2;
  const double longest = std::max({fast_length(c[1] - c[0]), fast_length(c[2] - c[1]), fast_length(c[0] - c[2])});
  const double wanted = std::max(longest / (2 * spacing_), area / (2 * spacing_ * spacing_));
  const int n = wanted < 2 ? 1 : wanted < 4 ? 4 : static_cast<int>(std::min(wanted, most_asked_back));
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const auto at = n > 4 ? spread_in_triangle(i + 0.5) : middles[static_cast<std::size_t>(n == 1 ? 1 : i)];
    const Vec3 p = c[0] + at[0] * (c[1] - c[0]) + at[1] * (c[2] - c[0]);
    const auto found = original_.ask(p, region, guess_);
    guess_ = found.triangle;
    sum += found.distance * found.distance;
    if (all && guess_ != ClosestPoint::no_guess) all->add(way_to(p, original_.surface[guess_]), area / n);
  }
  return area * sum / n;
}

void FittedSurface::Merged::clear() {
  faces.clear();
  old.clear();
  slots.clear();
  samples.clear();
  backward.clear();
}

double FittedSurface::key_of_merged() const {
  return merged_.cost / static_cast<double>(merged_.old.size() - merged_.faces.size());
}

void FittedSurface::enqueue_edge(std::uint32_t u, std::uint32_t v) {
  if (evaluate(u, v)) queue_.push({key_of_merged(), u, v, 0});
}

bool FittedSurface::has_edge(std::uint32_t u, std::uint32_t v) const {
  return std::ranges::any_of(faces_of_[u],
                             [&](std::uint32_t f) { return std::ranges::find(face_[f], v) != face_[f].end(); });
}

void FittedSurface::enqueue_face(std::uint32_t f) {
  if (const auto price = price_of_removal(f)) queue_.push({*price, f, f, face_stamp_[f]});
}

/// False when nothing would be left, or nothing saved.
bool FittedSurface::gather(std::uint32_t u, std::uint32_t v) {
  Merged& m = merged_;
  m.clear();
  m.old = faces_of_[v];
  for (auto f : faces_of_[u])
    if (std::ranges::find(face_[f], v) == face_[f].end()) m.old.push_back(f);
  for (auto f : m.old) {
    m.samples.insert(m.samples.end(), samples_of_[f].begin(), samples_of_[f].end());
    Face moved = face_[f];
    for (auto& c : moved)
      if (c == u) c = v;
    if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0]) continue;
    const bool twice = std::ranges::any_of(m.faces, [&](const Face& o) {
      return std::ranges::all_of(o, [&](std::uint32_t c) { return std::ranges::find(moved, c) != moved.end(); });
    });
    if (twice) continue;
    m.faces.push_back(moved);
    m.slots.push_back(f);
  }
  return !m.faces.empty() && m.faces.size() < m.old.size();
}

/// Some of the samples of the faces that are merged; the first half of them is spread over all of them, too.
void FittedSurface::ask(std::size_t most, const Vec3& origin) {
  const auto& samples = merged_.samples;
  const std::size_t stride = std::max<std::size_t>(1, (samples.size() + most - 1) / most);
  stands_for_ = static_cast<double>(stride);
  asked_.clear();
  for (const std::size_t first : {std::size_t{0}, stride})
    for (std::size_t i = first; i < samples.size(); i += 2 * stride) asked_.push_back(samples[i]);
  points_.reset(origin);
  for (auto s : asked_) add_point(s);
}

/// The integral over the samples, by the first `n` of those asked, and a better place for the vertex: where the squares
/// are least while each sample stays where it is on the faces.
double FittedSurface::forward(std::uint32_t v, const Vec3& x, std::size_t n, Vec3* better) {
  corners_.clear();
  for (const auto& f : merged_.faces) corners_.push_back(corners_of(f, v, x));
  list_regions(merged_.slots);
  nearest_faces(corners_, n, points_, regions_);
  double cost = 0, sum = 0, all = 0;
  Vec3 right{};
  for (std::size_t i = 0; i < n; ++i) {
    const auto s = asked_[i];
    const auto squared = static_cast<double>(points_.squared[i]);
    cost += cost_of(s, squared);
    if (!better) continue;
    const double w = samples_[s].weight;
    all += w;
    if (squared > samples_[s].enough) continue;
    const auto face = static_cast<std::size_t>(points_.face[i]);
    const Vec3& p = samples_[s].point;
    const auto at = closest_on_triangle(p, corners_[face]).at;
    const auto& f = merged_.faces[face];
    const std::size_t k = f[0] == v ? 0 : f[1] == v ? 1 : 2;
    const double b = at[k];
    if (b <= 0) continue;
    const auto &other = corners_[face][(k + 1) % 3], &third = corners_[face][(k + 2) % 3];
    const Vec3 rest = at[(k + 1) % 3] * other + at[(k + 2) % 3] * third;
    sum += w * b * b;
    right = right + w * b * (p - rest);
  }
  if (better) {
    const double hold = 1e-3 * all;
    *better = sum + hold > 0 ? (1 / (sum + hold)) * (right + hold * x) : x;
  }
  return cost * stands_for_ * static_cast<double>(asked_.size()) / static_cast<double>(std::max<std::size_t>(n, 1));
}

bool FittedSurface::turns_over(std::uint32_t u, std::uint32_t v) const {
  const Merged& m = merged_;
  for (std::size_t i = 0; i < m.faces.size(); ++i) {
    const Vec3 after = area_normal(corners_of(m.faces[i], v, m.position));
    const Vec3 before = area_normal(corners_of(face_[m.slots[i]], u, position_[u]));
    if (dot(before, after) < -0.2 * fast_length(before) * fast_length(after)) return true;
  }
  return false;
}

/// What it costs that two vertices become one, but for the way back, which takes longer to ask: it costs no less.
bool FittedSurface::evaluate(std::uint32_t u, std::uint32_t v) {
  if (!gather(u, v)) return false;
  Merged& m = merged_;
  ask(most_asked, position_[v]);
  const std::size_t n = asked_.size(), half = (n + 1) / 2;
  double before = 0, after = -1;
  for (auto s : asked_) before += cost_of(s, squared_[s]);
  before *= stands_for_;
  for (auto f : m.old) before += backward_[f];
  const Vec3 starts[] = {0.5 * (position_[u] + position_[v]), position_[v], position_[u]};
  Vec3 better{};
  for (const Vec3& x : starts) {
    Vec3 moved;
    const double cost = forward(v, x, half, &moved);
    if (after >= 0 && cost >= after) continue;
    after = cost;
    m.position = x;
    better = moved;
  }
  after = forward(v, m.position, n, nullptr);
  for (int i = 0; i < 2; ++i) {
    Vec3 moved;
    better = within_reach(better);
    const double cost = forward(v, better, n, i == 0 ? &moved : nullptr);
    if (cost >= after) break;
    after = cost;
    m.position = better;
    better = moved;
  }
  m.cost = after - before;
  return std::isfinite(m.cost) && !turns_over(u, v);
}

/// The faces that share a vertex with this one.
std::vector<std::uint32_t> FittedSurface::around(std::uint32_t f) const {
  std::vector<std::uint32_t> out;
  for (auto v : face_[f])
    for (auto o : faces_of_[v])
      if (o != f && std::ranges::find(out, o) == out.end()) out.push_back(o);
  return out;
}

/// Faces go that something hides, or that lie on others: of what is seen nothing is torn.
std::optional<double> FittedSurface::price_of_removal(std::uint32_t f) {
  const auto others = around(f);
  if (others.empty()) return std::nullopt;
  const auto c = corners_of(face_[f], none, {});
  const double area = length(area_normal(c)) / 2, same = 1e-4 * spacing_ * spacing_;
  merged_.samples = samples_of_[f];
  ask(most_asked, c[0]);
  const Vec3 middle = (1. / 3) * (c[0] + c[1] + c[2]);
  for (const Vec3& corner : c) {
    const Vec3 between = 0.5 * (corner + middle);
    region_.empty() ? points_.add(between) : points_.add(between, region_[f], std::numeric_limits<double>::infinity());
  }
  corners_.clear();
  for (auto o : others) corners_.push_back(corners_of(face_[o], none, {}));
  list_regions(others);
  nearest_faces(corners_, points_.n, points_, regions_);
  double cost = -backward_[f], seen = 0, known = 0;
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    const auto s = asked_[i];
    const auto squared = static_cast<double>(points_.squared[i]);
    const double weight = stands_for_ * samples_[s].weight;
    known += weight;
    if (squared > same && squared < samples_[s].enough) seen += weight;
    cost += stands_for_ * (cost_of(s, squared) - cost_of(s, squared_[s]));
  }
  // Where hardly a sample lies, the face itself is asked.
  for (std::size_t i = asked_.size(); i < points_.n && known < 0.5 * area; ++i)
    if (static_cast<double>(points_.squared[i]) > same) seen += area / 3;
  if (seen > 0.1 * area) return std::nullopt;
  return cost;
}

void FittedSurface::assign(std::span<const std::uint32_t> samples, std::span<const std::uint32_t> faces) {
  if (samples.empty()) return;
  points_.reset(samples_[samples[0]].point);
  for (auto s : samples) add_point(s);
  corners_.clear();
  for (auto f : faces) corners_.push_back(corners_of(face_[f], none, {}));
  list_regions(faces);
  nearest_faces(corners_, points_.n, points_, regions_);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    squared_[samples[i]] = static_cast<double>(points_.squared[i]);
    samples_of_[faces[static_cast<std::size_t>(points_.face[i])]].push_back(samples[i]);
  }
}

void FittedSurface::unlink(std::uint32_t f) {
  for (auto v : face_[f]) std::erase(faces_of_[v], f);
  samples_of_[f].clear();
}

void FittedSurface::merge(std::uint32_t u, std::uint32_t v) {
  const Merged m = merged_;
  std::vector<std::uint32_t> known;  // neighbours of v whose edges are in the queue, and stay cheap or are asked again
  if (n_faces_ <= few_fitted_faces)
    known.push_back(v);
  else
    for (auto f : faces_of_[v]) known.insert(known.end(), face_[f].begin(), face_[f].end());
  for (auto f : m.old) {
    unlink(f);
    alive_[f] = 0;
  }
  position_[v] = m.position;
  for (std::size_t i = 0; i < m.faces.size(); ++i) {
    const auto f = m.slots[i];
    face_[f] = m.faces[i];
    alive_[f] = 1;
    ++face_stamp_[f];
    for (auto c : face_[f]) faces_of_[c].push_back(f);
    backward_[f] = m.backward[i];
  }
  n_faces_ -= m.old.size() - m.faces.size();
  assign(m.samples, m.slots);
  faces_of_[u].clear();
  for (const auto& f : m.faces)
    for (auto c : f)
      if (std::ranges::find(known, c) == known.end()) {
        known.push_back(c);
        enqueue_edge(c, v);
      }
  if (n_faces_ > most_removable) return;
  for (auto f : m.slots) enqueue_face(f);
}

void FittedSurface::remove(std::uint32_t f) {
  const auto others = around(f);
  const auto samples = samples_of_[f];
  unlink(f);
  alive_[f] = 0;
  --n_faces_;
  assign(samples, others);
  for (auto o : others) {
    ++face_stamp_[o];
    enqueue_face(o);
  }
}

bool FittedSurface::step() {
  if (next_step()) return true;
  // What could not be done when it was asked may be possible now: the surface around it is another one.
  if (static_cast<double>(n_faces_) > worth_asking_again * static_cast<double>(n_enqueued_)) return false;
  enqueue_all();
  return next_step();
}

bool FittedSurface::next_step() {
  while (!queue_.empty()) {
    const Entry e = queue_.top();
    queue_.pop();
    if (e.from != e.to) {
      if (step_of_edge(e)) return true;
      continue;
    }
    if (!alive_[e.from] || e.stamp != face_stamp_[e.from]) continue;
    if (n_faces_ < 2) return false;
    // Its neighbours may have left since.
    if (!samples_of_[e.from].empty() && around(e.from).empty()) continue;
    remove(e.from);
    return true;
  }
  return false;
}

/// Much may have changed since the edge was priced: it goes back to the queue when another is cheaper now.
bool FittedSurface::step_of_edge(const Entry& e) {
  if (!has_edge(e.from, e.to) || !evaluate(e.from, e.to)) return false;
  auto waits = [&] {
    const double key = key_of_merged();
    if (queue_.empty() || !(key > queue_.top().key)) return false;
    queue_.push({key, e.from, e.to, 0});
    return true;
  };
  if (waits()) return false;
  for (std::size_t i = 0; i < merged_.faces.size(); ++i) {
    const auto corners = corners_of(merged_.faces[i], e.to, merged_.position);
    merged_.cost += merged_.backward.emplace_back(backward(corners, region_of(merged_.slots[i])));
  }
  if (!std::isfinite(merged_.cost) || waits()) return false;
  merge(e.from, e.to);
  return true;
}

/// Each vertex in turn to where the squares of the samples on its faces are least.
void FittedSurface::refine(int rounds) {
  for (; rounds > 0; --rounds) {
    for (std::uint32_t v = 0; v < position_.size(); ++v) {
      if (faces_of_[v].empty()) continue;
      Merged& m = merged_;
      m.clear();
      m.old = m.slots = faces_of_[v];
      for (auto f : m.old) {
        m.faces.push_back(face_[f]);
        m.samples.insert(m.samples.end(), samples_of_[f].begin(), samples_of_[f].end());
      }
      ask(2 * most_asked, position_[v]);
      Vec3 better;
      const double before = forward(v, position_[v], asked_.size(), &better);
      better = within_reach(better);
      const double after = forward(v, better, asked_.size(), nullptr);
      m.position = better;
      if (after < before && !turns_over(v, v)) position_[v] = better;
    }
    assign_again();
  }
  measure_backward();
}

Distortion FittedSurface::distortion() const {
  Distortion out = backward_all_;
  for (std::uint32_t f = 0; f < face_.size(); ++f)
    for (auto s : samples_of_[f])
      out.add(way_to(samples_[s].point, corners_of(face_[f], none, {}), samples_[s].enough), samples_[s].weight);
  return out;
}

PlainMesh FittedSurface::mesh() const {
  PlainMesh out;
  std::vector<std::uint32_t> number(position_.size(), none);
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    if (!alive_[f]) continue;
    auto& face = out.faces.emplace_back(face_[f]);
    if (!region_.empty()) out.regions.push_back(region_[f]);
    for (auto& v : face) {
      if (number[v] == none) {
        number[v] = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(position_[v]);
      }
      v = number[v];
    }
  }
  return out;
}

}  // namespace wrlkit::simplify

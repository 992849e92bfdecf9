#include "geometry/simplify/fitted_surface.h"

#include <algorithm>
#include <cmath>

#include "base/math/vec.h"
#include "geometry/simplify/closest_on_triangle.h"

namespace wrlkit::simplify {
namespace {

constexpr std::size_t most_asked = 48;       // samples that a price is made of
constexpr std::size_t most_removable = 256;  // faces from which on none is taken out by itself

}  // namespace

FittedSurface::FittedSurface(PlainMesh mesh, const ClosestPoint& original, std::span<const SurfaceSample> samples)
    : original_(original),
      samples_(samples),
      position_(std::move(mesh.positions)),
      face_(std::move(mesh.faces)),
      alive_(face_.size(), 1),
      backward_(face_.size()),
      faces_of_(position_.size()),
      samples_of_(face_.size()),
      squared_(samples.size()),
      stamp_(position_.size()),
      face_stamp_(face_.size()) {
  double area = 0;
  for (const auto& s : samples_) area += s.weight;
  spacing_ = std::sqrt(area / static_cast<double>(std::max<std::size_t>(samples_.size(), 1)));
  list_faces();
  assign_all();
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

/// Of all samples to all faces.
void FittedSurface::assign_all() {
  std::vector<std::uint32_t> corners, number;
  std::vector<double> flat;
  for (const Vec3& p : position_) flat.insert(flat.end(), p.begin(), p.end());
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    samples_of_[f].clear();
    if (!alive_[f]) continue;
    number.push_back(f);
    corners.insert(corners.end(), face_[f].begin(), face_[f].end());
    backward_[f] = backward(corners_of(face_[f], none, {}));
  }
  if (number.empty()) return;
  const ClosestPoint nearest(Triangles{flat, corners});
  auto guess = ClosestPoint::no_guess;
  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    const auto found = nearest.nearest(samples_[s].point, {}, guess);
    guess = found.triangle;
    if (guess == ClosestPoint::no_guess) continue;
    squared_[s] = found.distance * found.distance;
    samples_of_[number[guess]].push_back(s);
  }
}

/// With `v` at `x`.
std::array<Vec3, 3> FittedSurface::corners_of(const Face& f, std::uint32_t v, const Vec3& x) const {
  std::array<Vec3, 3> out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = f[k] == v ? x : position_[f[k]];
  return out;
}

/// The integral of the squared distance from a face to the original, by the middles of equal parts of it.
double FittedSurface::backward(const std::array<Vec3, 3>& c) const {
  const double area = length(area_normal(c)) / 2;
  const double longest = std::max({length(c[1] - c[0]), length(c[2] - c[1]), length(c[0] - c[2])});
  const int n = std::clamp(static_cast<int>(longest / (2 * spacing_)), 1, 2);
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 2 * i + 1; ++k) {
      // Row i of triangles, which point one way and the other by turns.
      const double third = k % 2 ? 2. / 3 : 1. / 3, u = (i + (k % 2 ? 1. / 3 : 2. / 3)) / n, v = (k / 2 + third) / n;
      const Vec3 p = c[0] + (u - v) * (c[1] - c[0]) + v * (c[2] - c[0]);
      const auto found = original_.nearest(p, {}, guess_);
      guess_ = found.triangle;
      sum += found.distance * found.distance;
    }
  return area * sum / (n * n);
}

std::uint32_t FittedSurface::stamp_of(const Entry& e) const {
  return e.from == e.to ? face_stamp_[e.from] : stamp_[e.from] + stamp_[e.to];
}

void FittedSurface::enqueue_edge(std::uint32_t u, std::uint32_t v) {
  Merged m;
  if (!evaluate(u, v, Price::at_least, m)) return;
  const auto saved = static_cast<double>(m.old.size() - m.faces.size());
  queue_.push({m.cost / saved, u, v, stamp_[u] + stamp_[v]});
}

void FittedSurface::enqueue_face(std::uint32_t f) {
  if (const auto price = price_of_removal(f)) queue_.push({*price, f, f, face_stamp_[f]});
}

/// False when nothing would be left, or nothing saved.
bool FittedSurface::gather(std::uint32_t u, std::uint32_t v, Merged& m) const {
  m.old = faces_of_[v];
  for (auto f : faces_of_[u])
    if (std::ranges::find(face_[f], v) == face_[f].end()) m.old.push_back(f);
  for (auto f : m.old) {
    m.samples.insert(m.samples.end(), samples_of_[f].begin(), samples_of_[f].end());
    Face moved = face_[f];
    for (auto& c : moved)
      if (c == u) c = v;
    if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0]) continue;
    Face sorted = moved;
    std::ranges::sort(sorted);
    const bool twice = std::ranges::any_of(m.faces, [&](Face o) {
      std::ranges::sort(o);
      return o == sorted;
    });
    if (twice) continue;
    m.faces.push_back(moved);
    m.slots.push_back(f);
  }
  return !m.faces.empty() && m.faces.size() < m.old.size();
}

/// The integral over the samples, and a better place for the vertex: where the squares are least while each sample
/// stays where it is on the faces.
double FittedSurface::forward(const Merged& m, std::uint32_t v, const Vec3& x, std::size_t stride, Vec3* better) const {
  double cost = 0, sum = 0, all = 0;
  Vec3 right{};
  std::vector<std::array<Vec3, 3>> corners;
  corners.reserve(m.faces.size());
  for (const auto& f : m.faces) corners.push_back(corners_of(f, v, x));
  for (std::size_t i = 0; i < m.samples.size(); i += stride) {
    const auto s = m.samples[i];
    const Vec3& p = samples_[s].point;
    ClosestOnTriangle best;
    std::size_t face = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto here = closest_on_triangle(p, corners[k]);
      if (here.squared < best.squared) {
        best = here;
        face = k;
      }
    }
    cost += cost_of(s, best.squared);
    const double w = samples_[s].weight;
    all += w;
    if (best.squared > samples_[s].enough) continue;
    const auto& f = m.faces[face];
    const std::size_t k = f[0] == v ? 0 : f[1] == v ? 1 : 2;
    const double b = best.at[k];
    if (b <= 0) continue;
    const auto &other = corners[face][(k + 1) % 3], &third = corners[face][(k + 2) % 3];
    const Vec3 rest = best.at[(k + 1) % 3] * other + best.at[(k + 2) % 3] * third;
    sum += w * b * b;
    right = right + w * b * (p - rest);
  }
  if (better) {
    const double hold = 1e-3 * all;
    *better = sum + hold > 0 ? (1 / (sum + hold)) * (right + hold * x) : x;
  }
  return cost * static_cast<double>(stride);
}

bool FittedSurface::turns_over(const Merged& m, std::uint32_t u, std::uint32_t v) const {
  for (std::size_t i = 0; i < m.faces.size(); ++i) {
    const Vec3 after = area_normal(corners_of(m.faces[i], v, m.position));
    const Vec3 before = area_normal(corners_of(face_[m.slots[i]], u, position_[u]));
    if (dot(before, after) < -0.2 * length(before) * length(after)) return true;
  }
  return false;
}

bool FittedSurface::evaluate(std::uint32_t u, std::uint32_t v, Price price, Merged& m) const {
  if (!gather(u, v, m)) return false;
  const std::size_t stride = (m.samples.size() + most_asked - 1) / most_asked;
  const auto step = std::max<std::size_t>(stride, 1);
  double before = 0, after = -1;
  for (std::size_t i = 0; i < m.samples.size(); i += step) before += cost_of(m.samples[i], squared_[m.samples[i]]);
  before *= static_cast<double>(step);
  for (auto f : m.old) before += backward_[f];
  const Vec3 starts[] = {0.5 * (position_[u] + position_[v]), position_[v], position_[u]};
  Vec3 better{};
  for (const Vec3& x : starts) {
    Vec3 moved;
    const double cost = forward(m, v, x, 2 * step, &moved);
    if (after >= 0 && cost >= after) continue;
    after = cost;
    m.position = x;
    better = moved;
  }
  after = forward(m, v, m.position, step, nullptr);
  for (int i = 0; i < (price == Price::whole ? 2 : 1); ++i) {
    Vec3 moved;
    const double cost = forward(m, v, better, step, &moved);
    if (cost >= after) break;
    after = cost;
    m.position = better;
    better = moved;
  }
  if (turns_over(m, u, v)) return false;
  if (price == Price::whole)
    for (const auto& f : m.faces) after += backward(corners_of(f, v, m.position));
  m.cost = after - before;
  return std::isfinite(m.cost);
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
std::optional<double> FittedSurface::price_of_removal(std::uint32_t f) const {
  const auto others = around(f);
  if (others.empty()) return std::nullopt;
  auto squared_to_others = [&](const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (auto o : others) least = std::min(least, closest_on_triangle(p, corners_of(face_[o], none, {})).squared);
    return least;
  };
  const auto c = corners_of(face_[f], none, {});
  const double area = length(area_normal(c)) / 2, same = 1e-4 * spacing_ * spacing_;
  double cost = -backward_[f], seen = 0;
  for (auto s : samples_of_[f]) {
    const double squared = squared_to_others(samples_[s].point);
    if (squared > same && squared < samples_[s].enough) seen += samples_[s].weight;
    cost += cost_of(s, squared) - cost_of(s, squared_[s]);
  }
  if (samples_of_[f].empty()) {
    const Vec3 middle = (1. / 3) * (c[0] + c[1] + c[2]);
    for (const Vec3& corner : c)
      if (squared_to_others(0.5 * (corner + middle)) > same) seen += area / 3;
  }
  if (seen > 0.1 * area) return std::nullopt;
  return cost;
}

void FittedSurface::assign(std::span<const std::uint32_t> samples, std::span<const std::uint32_t> faces) {
  for (auto s : samples) {
    double least = -1;
    std::uint32_t best = 0;
    for (auto f : faces) {
      const double d = closest_on_triangle(samples_[s].point, corners_of(face_[f], none, {})).squared;
      if (least >= 0 && d >= least) continue;
      least = d;
      best = f;
    }
    squared_[s] = least;
    samples_of_[best].push_back(s);
  }
}

void FittedSurface::unlink(std::uint32_t f) {
  for (auto v : face_[f]) std::erase(faces_of_[v], f);
  samples_of_[f].clear();
}

void FittedSurface::merge(std::uint32_t u, std::uint32_t v, const Merged& m) {
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
    backward_[f] = backward(corners_of(face_[f], none, {}));
  }
  n_faces_ -= m.old.size() - m.faces.size();
  assign(m.samples, m.slots);
  faces_of_[u].clear();
  std::vector<std::uint32_t> neighbours;
  for (const auto& f : m.faces)
    for (auto c : f)
      if (c != v && std::ranges::find(neighbours, c) == neighbours.end()) neighbours.push_back(c);
  ++stamp_[v];
  for (auto n : neighbours) ++stamp_[n];
  for (auto n : neighbours) enqueue_edge(n, v);
  if (n_faces_ > most_removable) return;
  for (auto f : m.slots) enqueue_face(f);
}

void FittedSurface::remove(std::uint32_t f) {
  const auto others = around(f);
  const auto samples = samples_of_[f];
  const auto face = face_[f];
  unlink(f);
  alive_[f] = 0;
  --n_faces_;
  assign(samples, others);
  for (auto v : face) ++stamp_[v];
  for (auto o : others) {
    ++face_stamp_[o];
    enqueue_face(o);
  }
}

bool FittedSurface::step() {
  while (!queue_.empty()) {
    const Entry e = queue_.top();
    queue_.pop();
    const bool is_face = e.from == e.to;
    if (is_face) {
      if (!alive_[e.from] || e.stamp != stamp_of(e)) continue;
      if (n_faces_ < 2) return false;
      remove(e.from);
      return true;
    }
    if (faces_of_[e.from].empty() || faces_of_[e.to].empty()) continue;
    Merged m;
    if (!evaluate(e.from, e.to, Price::whole, m)) continue;
    const double key = m.cost / static_cast<double>(m.old.size() - m.faces.size());
    if (!queue_.empty() && key > queue_.top().key) {
      queue_.push({key, e.from, e.to, stamp_of(e)});
      continue;
    }
    const bool still_an_edge = std::ranges::any_of(
        faces_of_[e.from], [&](std::uint32_t f) { return std::ranges::find(face_[f], e.to) != face_[f].end(); });
    if (!still_an_edge) continue;
    merge(e.from, e.to, m);
    return true;
  }
  return false;
}

/// Each vertex in turn to where the squares of the samples on its faces are least.
void FittedSurface::refine() {
  for (std::uint32_t v = 0; v < position_.size(); ++v) {
    if (faces_of_[v].empty()) continue;
    Merged m;
    m.old = m.slots = faces_of_[v];
    for (auto f : m.old) {
      m.faces.push_back(face_[f]);
      m.samples.insert(m.samples.end(), samples_of_[f].begin(), samples_of_[f].end());
    }
    Vec3 better;
    const std::size_t stride = std::max<std::size_t>(1, m.samples.size() / (2 * most_asked));
    const double before = forward(m, v, position_[v], stride, &better), after = forward(m, v, better, stride, nullptr);
    m.position = better;
    if (after < before && !turns_over(m, v, v)) position_[v] = better;
  }
  assign_all();
}

Distortion FittedSurface::distortion() const {
  Distortion out;
  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    out.squares += cost_of(s, squared_[s]);
    out.max = std::max(out.max, std::min(squared_[s], samples_[s].enough));
  }
  for (std::uint32_t f = 0; f < face_.size(); ++f)
    if (alive_[f]) out.squares += backward_[f];
  out.max = std::sqrt(out.max);
  return out;
}

PlainMesh FittedSurface::mesh() const {
  PlainMesh out;
  std::vector<std::uint32_t> number(position_.size(), none);
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    if (!alive_[f]) continue;
    auto& face = out.faces.emplace_back(face_[f]);
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

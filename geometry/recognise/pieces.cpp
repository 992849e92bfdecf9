#include "geometry/recognise/pieces.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/hashing.h"
#include "base/math/vec.h"

namespace wrlkit::recognising {
namespace {

/// Numbers of keys in the order in which they came, in a table of open addresses.
class Numbering {
 public:
  explicit Numbering(std::size_t most) : slots_(std::bit_ceil(most * 2 + 2), none) {}

  /// The number of a key, by `same(number)`; `fresh` when there is none yet.
  template <class Same>
  std::uint32_t find(std::uint64_t hash, std::uint32_t fresh, Same same) {
    for (std::size_t i = hash & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
      if (slots_[i] == none) return slots_[i] = fresh;
      if (same(slots_[i])) return slots_[i];
    }
  }

 private:
  std::vector<std::uint32_t> slots_;
};

std::uint64_t bits(double v) { return std::bit_cast<std::uint64_t>(v + 0.0); }

bool is_multiple(double v, double per) {
  const double scaled = v * per;
  return std::abs(scaled - std::nearbyint(scaled)) <= 1e-5 + std::abs(scaled) * 1e-14;
}

}  // namespace

double step_of(std::span<const double> numbers) {
  constexpr std::size_t most = 600;
  constexpr double exact = 1e-9;
  const std::size_t every = std::max<std::size_t>(1, numbers.size() / most);
  double per = 1, largest = 0;
  bool single = true;
  int decimals = 0;
  for (std::size_t i = 0; i < numbers.size(); i += every) {
    const double v = numbers[i];
    largest = std::max(largest, std::abs(v));
    single &= static_cast<double>(static_cast<float>(v)) == v;
    for (; decimals <= 7 && !is_multiple(v, per); ++decimals) per *= 10;
  }
  if (decimals <= 7) return 1 / per;
  return single ? largest * 0x1p-23 : largest * exact * 1e-3;
}

Pieces::Pieces(const Mesh& mesh, double step) : mesh_(mesh), step_(step > 0 ? step : step_of(mesh.positions.span())) {
  weld();
  link();
  seen_.assign(mesh_face_.size(), 0);
  flipped_.assign(mesh_face_.size(), 0);
  local_point_.assign(first_.size(), none);
  local_edge_.assign(origin_of_.size(), none);
}

Vec3 Pieces::at(std::uint32_t point) const {
  const double* p = mesh_.positions.data() + std::size_t{first_[point]} * 3;
  return {p[0], p[1], p[2]};
}

std::uint32_t Pieces::end_of(std::uint32_t h) const {
  return origin_of_[h + 1 == begin_[face_of_[h] + 1] ? begin_[face_of_[h]] : h + 1];
}

/// Points by position, faces without repeated corners.
void Pieces::weld() {
  const double* positions = mesh_.positions.data();
  Numbering points(mesh_.corners.size());
  std::vector<std::uint32_t> corners;
  for (std::uint32_t f = 0; f < mesh_.n_faces(); ++f) {
    corners.clear();
    for (std::size_t c = mesh_.begin_of(f); c < mesh_.end_of(f); ++c) {
      const double* p = positions + std::size_t{mesh_.corners[c]} * 3;
      const auto hash = mixed(mixed(bits(p[0]), bits(p[1])), bits(p[2]));
      const auto point = points.find(hash, static_cast<std::uint32_t>(first_.size()), [&](std::uint32_t other) {
        const double* q = positions + std::size_t{first_[other]} * 3;
        return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
      });
      if (point == first_.size()) first_.push_back(mesh_.corners[c]);
      if (corners.empty() || corners.back() != point) corners.push_back(point);
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3) {
      empty_.push_back(f);
      continue;
    }
    origin_of_.insert(origin_of_.end(), corners.begin(), corners.end());
    face_of_.insert(face_of_.end(), corners.size(), static_cast<std::uint32_t>(mesh_face_.size()));
    begin_.push_back(static_cast<std::uint32_t>(origin_of_.size()));
    mesh_face_.push_back(f);
  }
}

/// Half-edges with the same two points are twins when there are two of them.
void Pieces::link() {
  const auto n = static_cast<std::uint32_t>(origin_of_.size());
  Numbering edges(n);
  std::vector<std::uint32_t> ends(n), before(n, none), last(n);
  for (std::uint32_t h = 0; h < n; ++h) ends[h] = end_of(h);
  twin_.assign(n, none);
  std::vector<std::uint32_t> crowded;
  for (std::uint32_t h = 0; h < n; ++h) {
    const auto [low, high] = std::minmax(origin_of_[h], ends[h]);
    const auto first = edges.find(mixed(mixed(1, low), high), h, [&, low = low, high = high](std::uint32_t other) {
      return std::min(origin_of_[other], ends[other]) == low && std::max(origin_of_[other], ends[other]) == high;
    });
    if (first != h) {
      before[h] = last[first];
      if (last[first] == first) {
        twin_[h] = first;
        twin_[first] = h;
      } else if (before[last[first]] == first) {
        crowded.push_back(first);
      }
    }
    last[first] = h;
  }
  std::vector<std::uint32_t> all;
  for (auto first : crowded) {
    all.clear();
    for (auto h = last[first]; h != none; h = before[h]) all.push_back(h);
    std::ranges::reverse(all);
    pair_up(all);
  }
}

/// Where several parts touch along an edge: each front goes on where its inside ends first. Backs close before fronts
/// open, so that boxes side by side stay boxes.
void Pieces::pair_up(std::vector<std::uint32_t>& edges) {
  constexpr std::size_t most = 64;
  for (auto h : edges) twin_[h] = none;
  if (edges.size() > most) return;
  const auto u = origin_of_[edges[0]], v = end_of(edges[0]);
  const Vec3 along = unit(at(v) - at(u));
  struct Side {
    std::uint32_t edge;
    bool front;
    double angle;
  };
  std::vector<Side> sides;
  Vec3 first{}, second{};
  for (auto h : edges) {
    Vec3 normal{};
    const auto f = face_of_[h];
    const Vec3 start = at(origin_of_[begin_[f]]);
    for (auto k = begin_[f] + 1; k + 1 < begin_[f + 1]; ++k)
      normal = normal + cross(at(origin_of_[k]) - start, at(origin_of_[k + 1]) - start);
    const bool forward = origin_of_[h] == u;
    const Vec3 into = unit(forward ? cross(normal, along) : cross(along, normal));
    if (sides.empty()) {
      first = into;
      second = cross(along, into);
    }
    sides.push_back({h, forward == mesh_.ccw, std::atan2(dot(into, second), dot(into, first))});
  }
  constexpr double same = 1e-3;
  const double start = sides[0].angle + (sides[0].front ? same : -same);
  auto turned = [&](const Side& s) {  // downwards from the first front
    const double a = std::fmod(start - s.angle + 8 * std::acos(-1.0), 2 * std::acos(-1.0));
    return std::floor(a / same) + (s.front ? 0.5 : 0);
  };
  std::ranges::stable_sort(sides, {}, turned);
  std::vector<std::uint32_t> open;
  for (int round = 0; round < 2; ++round)
    for (const Side& s : sides) {
      if (twin_[s.edge] != none) continue;
      if (s.front && round == 0) open.push_back(s.edge);
      if (s.front || open.empty()) continue;
      twin_[s.edge] = open.back();
      twin_[open.back()] = s.edge;
      open.pop_back();
    }
}

/// The faces that hang together with one, in the order of the file. False when they cannot all be turned the same way.
bool Pieces::collect(std::uint32_t face) {
  faces_.assign(1, face);
  seen_[face] = 1;
  mixed_ = false;
  bool two_sided = true;
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const auto f = faces_[i];
    for (auto h = begin_[f]; h < begin_[f + 1]; ++h) {
      if (twin_[h] == none) continue;
      const auto g = face_of_[twin_[h]];
      const char flip = flipped_[f] ^ static_cast<char>(origin_of_[h] == origin_of_[twin_[h]]);
      if (!seen_[g]) {
        seen_[g] = 1;
        flipped_[g] = flip;
        mixed_ |= flip != 0;
        faces_.push_back(g);
      } else if (flipped_[g] != flip) {
        two_sided = false;
      }
    }
  }
  std::ranges::sort(faces_);
  return two_sided;
}

void Pieces::fill(Piece& piece) {
  const Vec3 start = at(origin_of_[begin_[faces_[0]]]);
  // Whole steps are subtracted exactly.
  const double unit = std::exp2(std::round(std::log2(std::max(step_, 1e-12))) + 10);
  for (std::size_t k = 0; k < 3; ++k) origin_[k] = std::round(start[k] / unit) * unit;
  piece = {};
  piece.mixed = mixed_;
  piece.begin.push_back(0);
  std::vector<std::uint32_t> used;
  for (auto f : faces_) {
    const auto begin = begin_[f], n = begin_[f + 1] - begin;
    const auto face = static_cast<std::uint32_t>(piece.mesh_face.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto point = origin_of_[begin + (flipped_[f] ? n - 1 - i : i)];
      if (local_point_[point] == none) {
        local_point_[point] = static_cast<std::uint32_t>(piece.points.size());
        used.push_back(point);
        piece.points.push_back(at(point) - origin_);
      }
      local_edge_[begin + (flipped_[f] ? (2 * n - 2 - i) % n : i)] = static_cast<std::uint32_t>(piece.origin.size());
      piece.origin.push_back(local_point_[point]);
      piece.face_of.push_back(face);
    }
    piece.begin.push_back(static_cast<std::uint32_t>(piece.origin.size()));
    piece.mesh_face.push_back(mesh_face_[f]);
  }
  piece.twin.resize(piece.origin.size(), none);
  for (auto f : faces_)
    for (auto h = begin_[f]; h < begin_[f + 1]; ++h)
      if (twin_[h] != none) piece.twin[local_edge_[h]] = local_edge_[twin_[h]];
  for (auto point : used) local_point_[point] = none;
  Vec3 low = piece.points[0], high = low;
  for (const Vec3& p : piece.points)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  piece.size = length(high - low);
  constexpr double coarsest = 0.005;  // of its size: what is written in fewer digits was meant so
  piece.step = std::min(step_, coarsest * piece.size);
  piece.find_regions();
}

bool Pieces::next(Piece& piece) {
  for (; cursor_ < mesh_face_.size(); ++cursor_) {
    if (seen_[cursor_]) continue;
    const bool whole = collect(cursor_);
    if (!whole || faces_.size() < 3) continue;
    fill(piece);
    if (std::isfinite(piece.size)) return true;
  }
  return false;
}

}  // namespace wrlkit::recognising

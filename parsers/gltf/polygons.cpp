#include "parsers/gltf/polygons.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <unordered_map>

#include "base/hashing.h"

namespace wrlkit::gltf_reader {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The outline of some triangles, from the first corner of the first on; empty when it is not one loop.
std::vector<std::uint32_t> outline(std::span<const std::uint32_t> t) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < t.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[i + k], t[i + (k + 1) % 3]);
  std::vector<Edge> sorted = edges;
  std::ranges::sort(sorted);
  std::vector<Edge> open;
  for (const Edge& e : sorted)
    if (!std::ranges::binary_search(sorted, Edge{e.second, e.first})) open.push_back(e);
  if (open.size() != t.size() / 3 + 2) return {};
  auto next = [&](std::uint32_t from) { return std::ranges::lower_bound(open, Edge{from, 0}); };
  std::uint32_t start = t[0];
  for (std::size_t i = 0; i < 3 && (next(start) == open.end() || next(start)->first != start); ++i) start = t[i];
  std::vector<std::uint32_t> loop;
  for (std::uint32_t v = start; loop.size() < open.size();) {
    auto e = next(v);
    if (e == open.end() || e->first != v) return {};
    loop.push_back(v);
    v = e->second;
    if (v == start) break;
  }
  return loop.size() == open.size() ? loop : std::vector<std::uint32_t>{};
}

/// The outline of two triangles that have one edge in common, from the first corner of the first on: what most faces
/// are, so that it is found without sorting.
std::optional<std::array<std::uint32_t, 4>> quadrilateral(std::span<const std::uint32_t> t) {
  const auto a = t.first(3), b = t.subspan(3);
  if (a[0] == a[1] || a[1] == a[2] || a[2] == a[0]) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto other = b[(k + 2) % 3];
      const bool common = a[i] == b[(k + 1) % 3] && a[(i + 1) % 3] == b[k];
      if (!common || std::ranges::find(a, other) != a.end()) continue;
      std::array<std::uint32_t, 4> loop{};
      std::ranges::copy(a.first(i + 1), loop.begin());
      loop[i + 1] = other;
      std::ranges::copy(a.subspan(i + 1), loop.begin() + static_cast<std::ptrdiff_t>(i) + 2);
      return loop;
    }
  return std::nullopt;
}

using Value = std::array<double, 4>;  // the widest that is joined: an RGBA colour

struct Hash {
  std::size_t operator()(const Value& a) const {
    std::uint64_t h = 0;
    for (double v : a) h = mixed(h, std::bit_cast<std::uint64_t>(v));
    return h;
  }
};

}  // namespace

Polygons polygons_of(std::span<const std::uint32_t> triangles, std::span<const double> runs) {
  Polygons out;
  std::size_t at = 0;
  auto take = [&](std::size_t n) {  // n triangles
    auto t = triangles.subspan(at, 3 * n);
    at += 3 * n;
    if (const auto four = n == 2 ? quadrilateral(t) : std::nullopt) {
      out.corners.insert(out.corners.end(), four->begin(), four->end());
      return out.close();
    }
    auto loop = n > 1 ? outline(t) : std::vector<std::uint32_t>{};
    if (!loop.empty()) {
      out.corners.insert(out.corners.end(), loop.begin(), loop.end());
      return out.close();
    }
    for (std::size_t i = 0; i < t.size(); i += 3) {
      out.corners.insert(out.corners.end(), t.begin() + static_cast<std::ptrdiff_t>(i),
                         t.begin() + static_cast<std::ptrdiff_t>(i) + 3);
      out.close();
    }
  };
  for (std::size_t r = 0; r + 1 < runs.size(); r += 2) {
    const double size = runs[r];
    for (double k = 0; k < runs[r + 1] && size >= 1 && size <= static_cast<double>((triangles.size() - at) / 3); ++k)
      take(static_cast<std::size_t>(size));
  }
  while (at + 3 <= triangles.size()) take(1);
  return out;
}

Polygons polylines(std::span<const std::uint32_t> segments) {
  Polygons out;
  for (std::size_t i = 0; i + 1 < segments.size(); i += 2) {
    const bool goes_on = i > 0 && segments[i] == segments[i - 1];
    if (!goes_on && i > 0) out.close();
    if (!goes_on) out.corners.push_back(segments[i]);
    out.corners.push_back(segments[i + 1]);
  }
  if (!segments.empty()) out.close();
  return out;
}

Joined join(std::span<const double> values, std::size_t width) {
  Joined out;
  std::unordered_map<Value, std::int32_t, Hash> seen;
  for (std::size_t i = 0; i + width <= values.size(); i += width) {
    Value key{};
    for (std::size_t k = 0; k < width; ++k) key[k] = values[i + k] + 0.0;  // -0 is 0
    auto [at, is_new] = seen.try_emplace(key, static_cast<std::int32_t>(out.values.size() / width));
    if (is_new)
      out.values.insert(out.values.end(), values.begin() + static_cast<std::ptrdiff_t>(i),
                        values.begin() + static_cast<std::ptrdiff_t>(i + width));
    out.of_vertex.push_back(at->second);
  }
  return out;
}

std::vector<std::int32_t> index_of(const Polygons& p, std::span<const std::int32_t> of_vertex) {
  std::vector<std::int32_t> out;
  out.reserve(p.corners.size() + p.size());
  for (std::size_t f = 0; f < p.size(); ++f) {
    for (auto i = p.begin[f]; i < p.begin[f + 1]; ++i) out.push_back(of_vertex[p.corners[i]]);
    out.push_back(-1);
  }
  return out;
}

std::vector<std::int32_t> face_index_of(const Polygons& p, std::span<const std::int32_t> of_vertex) {
  std::vector<std::int32_t> out;
  for (std::size_t f = 0; f < p.size(); ++f) out.push_back(of_vertex[p.corners[p.begin[f]]]);
  return out;
}

std::vector<std::int32_t> faces_of(std::span<const std::uint32_t> t) {
  std::vector<std::int32_t> out;
  out.reserve(t.size() / 3 * 4);
  for (std::size_t i = 0; i + 2 < t.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) out.push_back(static_cast<std::int32_t>(t[i + k]));
    out.push_back(-1);
  }
  return out;
}

std::vector<std::int32_t> polylines_of(std::span<const std::uint32_t> segments) {
  auto p = polylines(segments);
  std::vector<std::int32_t> out;
  for (std::size_t f = 0; f < p.size(); ++f) {
    for (auto i = p.begin[f]; i < p.begin[f + 1]; ++i) out.push_back(static_cast<std::int32_t>(p.corners[i]));
    out.push_back(-1);
  }
  return out;
}

bool counts_up(std::span<const std::int32_t> index) {
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] != static_cast<std::int32_t>(i)) return false;
  return true;
}

}  // namespace wrlkit::gltf_reader

#include "geometry/equal_geometry.h"

#include <array>
#include <cstring>

#include "base/hashing.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

constexpr int deepest = 4;  // levels of nodes; a Coordinate is on the second

/// The bytes of numbers; empty for nodes.
std::string_view bytes_of(const Value& v) {
  const auto& type = info(v.type);
  const auto bytes = [](auto span) {
    return std::string_view(reinterpret_cast<const char*>(span.data()), span.size_bytes());
  };
  if (type.element == Element::number) return bytes(v.number_span());
  if (type.element == Element::integer || type.element == Element::image) return bytes(v.integer_span());
  return {};
}

/// Lists that a file has again lie in one place.
bool same_bytes(std::string_view a, std::string_view b) {
  return a.size() == b.size() && (a.data() == b.data() || a == b);
}

bool is_plain(const Scene& scene, const Value& v) {
  return !v.is && !scene.is_extra(v) && info(v.type).element != Element::text;
}

/// Four sums at once, because each multiplication waits for the one before.
std::uint64_t hash_of_all(std::string_view bytes) {
  constexpr std::size_t step = 32;
  std::array<std::uint64_t, 4> sums{1, 2, 3, 4};
  const char* p = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= step; left -= step, p += step) {
    std::array<std::uint64_t, 4> now;
    std::memcpy(now.data(), p, step);
    for (std::size_t i = 0; i < now.size(); ++i) sums[i] = mixed(sums[i], now[i]);
  }
  std::array<std::uint64_t, 4> rest{};
  if (left > 0) std::memcpy(rest.data(), p, left);
  std::uint64_t h = bytes.size();
  for (std::size_t i = 0; i < rest.size(); ++i) h = mixed(mixed(h, sums[i]), rest[i]);
  return h;
}

/// Only pieces of long arrays count: thousands of Shapes may share a list of millions of points, which would be read
/// once for each of them.
std::uint64_t hash_of(std::string_view bytes) {
  constexpr std::size_t piece = 1024, n_pieces = 64;
  if (bytes.size() <= n_pieces * piece) return hash_of_all(bytes);
  const std::size_t step = (bytes.size() - piece) / (n_pieces - 1);
  std::uint64_t h = bytes.size();
  for (std::size_t i = 0; i < n_pieces; ++i) h = mixed(h, hash_of_all(bytes.substr(i * step, piece)));
  return h;
}

/// 0: it holds something that is not compared.
std::uint64_t hash_below(const Scene& scene, NodeId n, int depth) {
  if (depth == deepest) return 0;
  std::uint64_t h = mixed(static_cast<std::uint64_t>(depth) + 1, scene.type_id(n).value);
  for (const Value& v : scene.fields(n)) {
    if (!is_plain(scene, v)) return 0;
    h = mixed(h, v.slot);
    if (info(v.type).element != Element::node) h = mixed(h, hash_of(bytes_of(v)));
    for (const NodeId child : v.node_span()) {
      const auto below = hash_below(scene, child, depth + 1);
      if (below == 0) return 0;
      h = mixed(h, below);
    }
  }
  return h;
}

}  // namespace

std::uint64_t EqualGeometry::hash_of(const Scene& scene, NodeId n) {
  const bool is_list =
      scene.is(n, nodes::IndexedFaceSet) || scene.is(n, nodes::IndexedLineSet) || scene.is(n, nodes::PointSet);
  return is_list ? hash_below(scene, n, 0) : 0;
}

bool EqualGeometry::same(const Scene& scene, NodeId a, NodeId b) {
  if (a == b) return true;
  const auto x = scene.fields(a), y = scene.fields(b);
  if (scene.type_id(a) != scene.type_id(b) || x.size() != y.size()) return false;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i].type != y[i].type || x[i].slot != y[i].slot || !same_bytes(bytes_of(x[i]), bytes_of(y[i]))) return false;
    const auto p = x[i].node_span(), q = y[i].node_span();
    if (p.size() != q.size()) return false;
    for (std::size_t k = 0; k < p.size(); ++k)
      if (!same(scene, p[k], q[k])) return false;
  }
  return true;
}

std::uint64_t EqualGeometry::hash(NodeId n) {
  if (hashed_ != n) know(n, hash_of(scene_, n), {});
  return hash_;
}

NodeId EqualGeometry::find(NodeId n) {
  const auto h = hash(n);
  if (h == 0) return {};
  const auto known = nodes_.find(h);
  if (known == nodes_.end()) return {};
  return known->second == same_ || same(scene_, known->second, n) ? known->second : NodeId{};
}

void EqualGeometry::add(NodeId n) {
  if (const auto h = hash(n); h != 0) nodes_.emplace(h, n);
}

}  // namespace wrlkit

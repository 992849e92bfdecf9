#include "writers/gltf/morphs.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"
#include "writers/gltf/number.h"

namespace wrlkit::gltf {
namespace {

NodeId node_in(const Scene& scene, NodeId n, std::string_view field) {
  auto slot = scene.type(n).find(field, Dialect::x3d);
  const Value* v = slot ? scene.find(n, *slot) : nullptr;
  return v && !v->is && v->type == FieldType::SFNode ? v->node : NodeId{};
}

}  // namespace

struct Morphs::Source {
  NodeId geometry;
  const Mesh& mesh;
  const SplitScratch& scratch;
  const Vertices& vertices;
  bool normals = false;  // the targets have them; points they have always, which three.js asks for
  bool made_normals = false;
  std::map<Morph::Target, std::uint32_t> known{};
  std::vector<std::uint32_t> group{};  // of vertices: those of one point and one normal
  std::size_t n_groups = 0;
};

bool Morphs::moves(NodeId n) const {
  if (motion_.fields().empty()) return false;
  const NodeId coord = node_in(scene_, n, "coord"), normal = node_in(scene_, n, "normal");
  return (scene_.is(coord, nodes::Coordinate) && motion_.moves(coord, nodes::coordinate::point.slot)) ||
         (scene_.is(normal, nodes::Normal) && motion_.moves(normal, nodes::normal::vector.slot));
}

bool Morphs::makes_normals(NodeId n) const {
  if (motion_.fields().empty()) return false;
  const NodeId coord = node_in(scene_, n, "coord");
  return scene_.is(n, nodes::IndexedFaceSet) && !node_in(scene_, n, "normal") && scene_.is(coord, nodes::Coordinate) &&
         motion_.moves(coord, nodes::coordinate::point.slot);
}

std::uint32_t Morphs::add(NodeId n, const Mesh& mesh, const SplitScratch& scratch, const Vertices& vertices) {
  if (motion_.fields().empty()) return none;
  const NodeId coord = node_in(scene_, n, "coord"), normal = node_in(scene_, n, "normal");
  Source s{n, mesh, scratch, vertices};
  const bool moves = scene_.is(coord, nodes::Coordinate) && motion_.moves(coord, nodes::coordinate::point.slot);
  const bool turns =
      scene_.is(normal, nodes::Normal) && motion_.moves(normal, nodes::normal::vector.slot) && !vertices.normal.empty();
  s.made_normals = makes_normals(n) && !vertices.normal.empty();
  s.normals = turns || s.made_normals;
  if (s.made_normals) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> groups;
    for (const auto& v : scratch.vertices)
      s.group.push_back(
          groups.try_emplace({v.position, v.normal}, static_cast<std::uint32_t>(groups.size())).first->second);
    s.n_groups = groups.size();
  }
  Morph m;
  bool any = moves && collect(m, s, coord, nodes::coordinate::point.slot, false);
  any |= turns && collect(m, s, normal, nodes::normal::vector.slot, true);
  if (!any || m.targets.empty()) return none;
  morphs_.push_back(std::move(m));
  return static_cast<std::uint32_t>(morphs_.size() - 1);
}

/// The targets of all interpolators of a field. Nothing of those that do not fit.
bool Morphs::collect(Morph& m, Source& s, NodeId node, std::uint16_t slot, bool normals) {
  auto index = [&](const SplitScratch::Vertex& v) { return normals ? v.normal : v.position; };
  std::size_t highest = 0;
  for (const auto& v : s.scratch.vertices) highest = std::max<std::size_t>(highest, index(v));
  const auto own = scene_.value(node, slot).number_span().size() / 3;
  bool any = false;
  for (const auto& d : motion_.drives(node, slot)) {
    const NodeId interpolator = motion_.curve(d.curve).interpolator;
    if (m.of_keys.contains(interpolator.value)) {
      any = true;
      continue;
    }
    const std::size_t n_keys = keys(scene_, interpolator).size(), per_key = values_per_key(scene_, interpolator);
    const bool fits = per_key > highest && own == (normals ? s.mesh.normal.count() : s.mesh.n_positions());
    n_vertices_ += n_keys * s.vertices.count();
    if (!fits || m.targets.size() + n_keys > max_targets || n_vertices_ > max_vertices) {
      diag_.report(Diag::no_gltf_value, scene_.where(interpolator), scene_.type(interpolator).name,
                   fits ? "keyValue, as it is too long," : "keyValue, as it does not fit the points,");
      continue;
    }
    auto& list = m.of_keys[interpolator.value];
    for (std::size_t k = 0; k < n_keys; ++k)
      list.push_back(target(m, s, key_values(scene_, interpolator).subspan(k * per_key * 3, per_key * 3), normals));
    any = true;
  }
  if (any) m.inputs.push_back({node.value, slot});
  return any;
}

/// The target of these values; none when they are the values of the file.
std::uint32_t Morphs::target(Morph& m, Source& s, std::span<const double> values, bool normals) {
  const std::size_t n = s.vertices.count();
  std::vector<double> moved(3 * n);
  std::vector<float> position(3 * n), normal(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& v = s.scratch.vertices[i];
    const double* to = &values[std::size_t{3} * (normals ? v.normal : v.position)];
    const double size = normals ? fast_length(vec3(to)) : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      moved[3 * i + k] = to[k];
      if (normals)
        normal[3 * i + k] = size > 0 ? to_float(to[k] / size) - s.vertices.normal[3 * i + k] : 0;
      else
        position[3 * i + k] = to_float(to[k] - s.mesh.positions[std::size_t{3} * v.position + k]);
    }
  }
  if (!normals && s.made_normals) normal = normals_at(s, moved);
  auto still = [](const std::vector<float>& v) {
    return std::ranges::all_of(v, [](float x) { return std::abs(x) < 1e-12f; });
  };
  if (still(position) && ((!normals && s.made_normals) || still(normal))) return none;  // normals are made to rounding
  Morph::Target t;
  t.positions = store_.positions(position, box_of<3, float>(position));
  if (s.normals) t.normals = store_.vertices(View::normal, normal);
  auto [at, is_new] = s.known.try_emplace(t, static_cast<std::uint32_t>(m.targets.size()));
  if (is_new) m.targets.push_back(t);
  return at->second;
}

/// How the normals of moved points differ from those of the points as they stand: of all vertices of one point and one
/// normal, that of the faces around it, each by its angle there.
std::vector<float> Morphs::normals_at(const Source& s, const std::vector<double>& p) const {
  const auto& index = s.vertices.index;
  std::vector<Vec3> sums(s.n_groups, Vec3{0, 0, 0});
  for (std::size_t t = 0; t + 2 < index.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const double *a = &p[std::size_t{3} * index[t + k]], *b = &p[std::size_t{3} * index[t + (k + 1) % 3]],
                   *c = &p[std::size_t{3} * index[t + (k + 2) % 3]];
      const Vec3 x = vec3(b) - vec3(a), y = vec3(c) - vec3(a), up = cross(x, y);
      const double size = fast_length(up), angle = std::atan2(size, dot(x, y));
      if (!(size > 0)) continue;
      Vec3& sum = sums[s.group[index[t + k]]];
      for (std::size_t i = 0; i < 3; ++i) sum[i] += up[i] / size * angle;
    }
  std::vector<float> out(p.size(), 0);
  for (std::size_t v = 0; v < s.group.size(); ++v) {
    const Vec3& sum = sums[s.group[v]];
    const double size = fast_length(sum);
    for (std::size_t i = 0; size > 0 && i < 3; ++i)
      out[3 * v + i] = static_cast<float>(sum[i] / size - s.vertices.normal[3 * v + i]);
  }
  return out;
}

Property Morphs::weights(std::uint32_t id, std::vector<std::uint32_t> nodes) const {
  const Morph& m = morphs_[id];
  auto evaluate = [&m](std::span<const Property::At> in, std::vector<double>& out) {
    out.assign(m.targets.size(), 0);
    for (const auto& at : in) {
      auto keys = at.curve ? m.of_keys.find(at.curve->interpolator.value) : m.of_keys.end();
      if (keys == m.of_keys.end()) continue;
      const auto& list = keys->second;
      const auto i = std::min(static_cast<std::size_t>(at.place), list.size() - 1);
      const double t = at.place - static_cast<double>(i);
      if (list[i] != none) out[list[i]] += 1 - t;
      if (i + 1 < list.size() && t > 0 && list[i + 1] != none) out[list[i + 1]] += t;
    }
  };
  return {std::move(nodes), "weights", m.targets.size(), m.inputs, evaluate};
}

}  // namespace wrlkit::gltf

#include "writers/gltf/document/place_tables.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"

namespace wrlkit::gltf {
namespace {

/// Single precision gives it to a tenth of a millimetre.
bool fits(const Vec3& v, double growth) {
  return std::ranges::all_of(
      v, [&](double x) { return std::abs(static_cast<double>(static_cast<float>(x)) - x) * growth <= 1e-4; });
}

bool is_plain_or_root(const Scene& scene, NodeId n) {
  return !n || scene.is(n, nodes::Transform) || scene.is(n, nodes::Group);
}

/// The children that are left; the first of each kind stands for those that go.
std::size_t share_places(Document& d, const Makers& m, std::span<std::uint32_t> siblings, std::vector<Mark>& marks) {
  if (siblings.size() < least_instances) return siblings.size();
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_mesh;
  for (auto id : siblings)
    if (marks[id] == Mark::nothing && only_places_a_mesh(m, d.nodes[id], d.place(d.nodes[id])))
      by_mesh[d.nodes[id].attached].push_back(id);
  for (const auto& [mesh, all] : by_mesh) {
    if (all.size() < least_instances) continue;
    Instances table;
    for (auto id : all) {
      table.sources.push_back(d.nodes[id].source);
      table.places.push_back(d.place(d.nodes[id]));
      marks[id] = Mark::row;
    }
    marks[all[0]] = Mark::nothing;
    d.nodes[all[0]] = {
        .attached = mesh, .attachment = Attachment::mesh, .instances = static_cast<std::uint32_t>(d.instances.size())};
    d.instances.push_back(std::move(table));
  }
  const auto rest = std::remove_if(siblings.begin(), siblings.end(), [&](auto id) { return marks[id] == Mark::row; });
  return static_cast<std::size_t>(rest - siblings.begin());
}

void store(Instances& all, Store& to) {
  std::vector<float> t, r, s, ids;
  bool turned = false, scaled = false, moved = false;
  for (const Trs& p : all.places) {
    for (double v : p.translation) t.push_back(static_cast<float>(v));
    for (double v : {p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w}) r.push_back(static_cast<float>(v));
    for (double v : p.scale) s.push_back(static_cast<float>(v));
    moved |= p.translation != Vec3{0, 0, 0};
    turned |= !p.rotation.identity();
    scaled |= p.scale != Vec3{1, 1, 1};
  }
  // One of them has to give how many there are.
  if (moved || !(turned || scaled)) all.translations = to.vertices(View::moving3, t);
  if (turned) all.rotations = to.vertices(View::moving4, r);
  if (scaled) all.scales = to.vertices(View::moving3, s);
  for (auto row : all.rows) ids.push_back(static_cast<float>(row == none ? no_part : row));
  if (std::ranges::any_of(all.rows, [](auto row) { return row != none; })) all.features = to.vertices(View::part, ids);
}

}  // namespace

bool only_places_a_mesh(const Makers& m, const Node& n, const Trs& t, double growth) {
  if (n.attachment != Attachment::mesh || n.n_children > 0 || n.lod || n.hidden || n.choice != none || !n.source ||
      m.animations.moves(n.source))
    return false;
  if (!is_plain_or_root(m.scene, n.source) && !m.scene.is(n.source, nodes::Shape)) return false;
  const Geometry& g = m.meshes.geometries()[m.meshes.meshes()[n.attached].geometry];
  // Renderers make instances of triangles only.
  if (g.morph != none || g.features != none || g.mode != Mode::triangles) return false;
  if (!fits(t.translation, growth) || !fits(t.scale, 1) || !(t.scale[0] * t.scale[1] * t.scale[2] > 0)) return false;
  const bool table = m.options.names == GltfOptions::Names::table;  // tags stand with its rows
  if (!m.keeps_everything()) return table || !m.extras || !has_tags(m.scene, n.source);
  return n.same_as == none && !m.extras->is_routed(n.source) &&
         !m.extras->says_more(n.source, t.identity() ? nodes::Shape : nodes::Transform, n.plain);
}

void make_instances(Document& d, const Makers& m) {
  std::vector<Mark> marks(d.nodes.size(), Mark::nothing);
  const bool says_same = m.keeps_everything();
  if (says_same)
    for (const Node& n : d.nodes)
      if (n.same_as != none) marks[n.same_as] = Mark::referred;
  for (Node& n : d.nodes)
    if (!says_same || is_plain_or_root(m.scene, n.source))
      n.n_children =
          static_cast<std::uint32_t>(share_places(d, m, {d.children.data() + n.first_child, n.n_children}, marks));
  d.roots.resize(share_places(d, m, d.roots, marks));
  if (!d.instances.empty()) m.animations.renumber(remove_rows(d, marks));
}

void store_instances(Document& d, Store& to) {
  for (Instances& all : d.instances) store(all, to);
}

}  // namespace wrlkit::gltf

#include "writers/gltf/instances.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"
#include "writers/gltf/hierarchy.h"

namespace wrlkit::gltf {
namespace {

/// Single precision says it to a tenth of a millimetre.
bool fits(const Vec3& v, double growth) {
  return std::ranges::all_of(
      v, [&](double x) { return std::abs(static_cast<double>(static_cast<float>(x)) - x) * growth <= 1e-4; });
}

bool is_plain_group(const Scene& scene, NodeId n) {
  return !n || scene.is(n, nodes::Transform) || scene.is(n, nodes::Group);
}

}  // namespace

/// Nothing is lost when it is a row of a table. Mirror images stay: renderers take which side is the front from the
/// node.
bool Hierarchy::only_places_a_mesh(const Node& n, const Trs& t, double growth) const {
  if (n.attachment != Attachment::mesh || n.n_children > 0 || n.lod || !n.source || animations_.moves(n.source))
    return false;
  if (!is_plain_group(scene_, n.source) && !scene_.is(n.source, nodes::Shape)) return false;
  const Geometry& g = meshes_.geometries()[meshes_.meshes()[n.attached].geometry];
  if (g.morph != none || g.features != none) return false;
  if (!fits(t.translation, growth) || !fits(t.scale, 1) || !(t.scale[0] * t.scale[1] * t.scale[2] > 0)) return false;
  if (!extras_ || options_.facts_only) return true;
  return n.same_as == none && !extras_->is_routed(n.source) &&
         !extras_->says_more(n.source, t.identity() ? nodes::Shape : nodes::Transform, n.plain);
}

/// The children that are left; the first of each kind stands for those that go.
std::size_t Hierarchy::share_places(std::span<std::uint32_t> siblings, std::vector<Mark>& marks) {
  if (siblings.size() < least_instances) return siblings.size();
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_mesh;
  for (auto id : siblings)
    if (marks[id] == Mark::nothing &&
        only_places_a_mesh(nodes_[id], nodes_[id].transform == none ? Trs{} : transforms_[nodes_[id].transform]))
      by_mesh[nodes_[id].attached].push_back(id);
  for (const auto& [mesh, all] : by_mesh) {
    if (all.size() < least_instances) continue;
    Instances table;
    for (auto id : all) {
      table.sources.push_back(nodes_[id].source);
      table.places.push_back(nodes_[id].transform == none ? Trs{} : transforms_[nodes_[id].transform]);
      marks[id] = Mark::row;
    }
    marks[all[0]] = Mark::nothing;
    nodes_[all[0]] = {
        .attached = mesh, .attachment = Attachment::mesh, .instances = static_cast<std::uint32_t>(instances_.size())};
    instances_.push_back(std::move(table));
  }
  const auto rest = std::remove_if(siblings.begin(), siblings.end(), [&](auto id) { return marks[id] == Mark::row; });
  return static_cast<std::size_t>(rest - siblings.begin());
}

void Hierarchy::make_instances() {
  std::vector<Mark> marks(nodes_.size(), Mark::nothing);
  const bool says_same = extras_ && !options_.facts_only;
  if (says_same)
    for (const Node& n : nodes_)
      if (n.same_as != none) marks[n.same_as] = Mark::referred;
  for (Node& n : nodes_)
    if (!says_same || is_plain_group(scene_, n.source))
      n.n_children = static_cast<std::uint32_t>(share_places({children_.data() + n.first_child, n.n_children}, marks));
  roots_.resize(share_places(roots_, marks));
  if (!instances_.empty()) leave_out(marks);
}

/// Rows are no nodes any more; all others move up.
void Hierarchy::leave_out(const std::vector<Mark>& marks) {
  std::vector<std::uint32_t> became(nodes_.size(), none);
  std::vector<Node> left;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (marks[i] == Mark::row) continue;
    became[i] = static_cast<std::uint32_t>(left.size());
    left.push_back(nodes_[i]);
  }
  nodes_ = std::move(left);
  auto renumber = [&](std::vector<std::uint32_t>& all) {
    for (auto& id : all) id = became[id];
  };
  renumber(roots_);
  for (Node& n : nodes_) {
    if (n.same_as != none) n.same_as = became[n.same_as];
    for (std::uint32_t i = 0; i < n.n_children; ++i)
      children_[n.first_child + i] = became[children_[n.first_child + i]];
  }
  std::unordered_map<std::uint32_t, Lod> lods;
  for (auto& [id, lod] : lods_) {
    renumber(lod.levels);
    lods.emplace(became[id], std::move(lod));
  }
  lods_ = std::move(lods);
  animations_.renumber(became);
}

void Hierarchy::store_instances(Store& store) {
  for (Instances& all : instances_) {
    std::vector<float> t, r, s;
    bool turned = false, scaled = false, moved = false;
    for (const Trs& p : all.places) {
      for (double v : p.translation) t.push_back(static_cast<float>(v));
      for (double v : {p.rotation.x, p.rotation.y, p.rotation.z, p.rotation.w}) r.push_back(static_cast<float>(v));
      for (double v : p.scale) s.push_back(static_cast<float>(v));
      moved |= p.translation != Vec3{0, 0, 0};
      turned |= !p.rotation.identity();
      scaled |= p.scale != Vec3{1, 1, 1};
    }
    // One of them has to say how many there are.
    if (moved || !(turned || scaled)) all.translations = store.vertices(View::moving3, t);
    if (turned) all.rotations = store.vertices(View::moving4, r);
    if (scaled) all.scales = store.vertices(View::moving3, s);
    std::vector<float> ids;
    for (auto row : all.rows) ids.push_back(static_cast<float>(row == none ? no_part : row));
    if (std::ranges::any_of(all.rows, [](auto row) { return row != none; }))
      all.features = store.vertices(View::part, ids);
  }
}

}  // namespace wrlkit::gltf

#include "passes/merge/still_places.h"

#include <algorithm>
#include <utility>

#include "scenegraph/nodes.h"
#include "scenegraph/places/name_path.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::uint32_t no_zone = 0xffffffff;

}  // namespace

StillPlaces::StillPlaces(const Scene& scene, const Usage& usage, bool by_name)
    : scene_(scene),
      usage_(usage),
      by_name_(by_name),
      bound_(scene.node_count()),
      takers_(scene.node_count()),
      chosen_(scene.node_count()),
      zone_at_(scene.node_count()),
      listed_(scene.node_count()),
      fixed_(scene.node_count()),
      named_(scene.node_count()),
      ways_(scene) {
  find_bound();
  find_alternatives();
  walk();
  // A Shape that has to stay somewhere stays everywhere.
  const std::size_t before = places_.size();
  std::erase_if(places_, [&](const StillPlace& p) {
    return fixed_[p.shape.value] || takers_[p.shape.value] != usage_.uses(p.shape);
  });
  n_fixed_ += before - places_.size();
}

/// Bodies of prototypes may share nodes with the world.
void StillPlaces::find_bound() {
  std::vector<NodeId> all;
  for (std::uint32_t i = 0; i < scene_.proto_count(); ++i)
    reach(scene_, scene_.proto(ProtoId{i}).body.roots, bound_, all);
}

void StillPlaces::find_alternatives() {
  for (const NodeId n : reachable(scene_, scene_.main))
    if (scene_.is(n, nodes::Switch) || scene_.is(n, nodes::LOD))
      for (const NodeId c : hierarchy_children(scene_, n))
        if (c) ++chosen_[c.value];
}

void StillPlaces::walk() {
  for (NodeId n : scene_.main.roots)
    if (n) ++takers_[n.value];
  ways_.push(scene_.main.roots, {.zone = 0, .frame = {}, .path = 0, .shown = true});
  while (const auto way = ways_.next()) visit(way->node, way->state);
}

bool StillPlaces::is_apart(NodeId n) const {
  return (by_name_ && !scene_.name(n).empty()) || holds_together(scene_, usage_, n);
}

bool StillPlaces::may_take(NodeId shape) const {
  const NodeId g = scene_.get(shape, nodes::shape::geometry);
  if (bound_[shape.value] || !is_plain(shape) || !is_plain(g) || !scene_.is(g, nodes::X3DGeometryNode)) return false;
  bool plain = true;
  for_each_child(scene_, g, [&](NodeId c) {
    plain &= is_plain(c) && !scene_.is(c, nodes::TextureCoordinateGenerator) && !scene_.is(c, nodes::MetadataSet);
  });
  return plain && !(scene_.is(g, nodes::IndexedFaceSet) && scene_.get(g, nodes::indexed_face_set::lightCoord));
}

void StillPlaces::visit(NodeId node, const Handed& i) {
  const auto path_below = [&] {
    if (scene_.name(node).empty()) return i.path;
    paths_.push_back({scene_.name(node), i.path});
    return static_cast<std::uint32_t>(paths_.size() - 1);
  };
  if (scene_.is(node, nodes::Shape)) {
    const NodeId g = scene_.get(node, nodes::shape::geometry);
    if (!g) return;
    if (!may_take(node)) fixed_[node.value] = 1;
    Handed at = i;
    at.path = path_below();
    // The name of a geometry tells parts apart that have no other; where they have, it is kept with the first.
    const bool first = !std::exchange(named_[g.value], 1);
    if ((first || scene_.name(node).empty()) && !scene_.name(g).empty()) {
      paths_.push_back({scene_.name(g), at.path});
      at.path = static_cast<std::uint32_t>(paths_.size() - 1);
    }
    if (i.zone != no_zone)
      places_.push_back({node, i.zone, i.frame, at.path});
    else {
      n_fixed_ += i.shown;
      fixed_[node.value] = 1;
    }
    return;
  }
  if (hierarchy_children(scene_, node).empty()) return;
  const bool known =
      (scene_.is(node, nodes::X3DGroupingNode) || scene_.is(node, nodes::StaticGroup)) && !bound_[node.value];
  Handed below = i;
  below.path = path_below();
  if (!known) {
    below.zone = no_zone;
    return children(node, below);
  }
  if (scene_.is(node, nodes::Switch) || scene_.is(node, nodes::LOD)) return alternatives(node, below);
  below.frame = i.frame * local_matrix(scene_, node);
  if (is_apart(node)) {
    bool fresh;
    below.zone = zone_of(node, i.shown, fresh);
    below.frame = {};
    if (!fresh) return;
  }
  children(node, below);
}

void StillPlaces::children(NodeId group, const Handed& as) {
  const auto list = hierarchy_children(scene_, group);
  if (as.zone != no_zone && !std::exchange(listed_[group.value], 1)) {
    groups_.push_back(group);
    // The proxy of a Collision is not a list.
    for (const Value& v : scene_.fields(group))
      if (!v.is && !scene_.is_extra(v) && v.type == FieldType::MFNode)
        for (NodeId c : v.node_span()) ++takers_[c.value];
  }
  ways_.push(list, as);
}

/// Each child of a Switch or LOD is a scene of its own, unless it stands elsewhere, too.
void StillPlaces::alternatives(NodeId node, const Handed& i) {
  const auto shown = shown_children(scene_, node);
  const auto list = hierarchy_children(scene_, node);
  for (auto n = list.rbegin(); n != list.rend(); ++n) {
    if (!*n) continue;
    Handed below = i;
    below.shown = i.shown && std::ranges::find(shown, *n) != shown.end();
    const bool group = !scene_.is(*n, nodes::Shape) && scene_.is(*n, nodes::X3DGroupingNode) &&
                       !scene_.is(*n, nodes::Switch) && !scene_.is(*n, nodes::LOD) && !bound_[n->value] &&
                       chosen_[n->value] == usage_.uses(*n);
    if (!group) {
      below.zone = no_zone;
      ways_.push(*n, below);
      continue;
    }
    bool fresh;
    below.zone = zone_of(*n, below.shown, fresh);
    if (!fresh) continue;
    if (!scene_.name(*n).empty()) {
      paths_.push_back({scene_.name(*n), i.path});
      below.path = static_cast<std::uint32_t>(paths_.size() - 1);
    }
    below.frame = {};
    children(*n, below);
  }
}

std::uint32_t StillPlaces::zone_of(NodeId holder, bool shown, bool& fresh) {
  auto& z = zone_at_[holder.value];
  if ((fresh = z == 0)) {
    zones_.push_back({holder});
    z = static_cast<std::uint32_t>(zones_.size());
  }
  zones_[z - 1].times += shown;
  return z - 1;
}

std::string StillPlaces::name(std::uint32_t path) const {
  std::vector<std::string_view> upwards;
  for (; path; path = paths_[path].above) upwards.push_back(paths_[path].name);
  std::string out;
  for (auto name = upwards.rbegin(); name != upwards.rend(); ++name) out = path_below(out, *name);
  return out;
}

}  // namespace wrlkit

// --names table: groups that do nothing but hold parts, and the parts in them, become rows of the table of names; what
// a mesh is placed by becomes a table of places, whatever group it was in.
#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"
#include "writers/gltf/hierarchy.h"

namespace wrlkit::gltf {
namespace {

constexpr int most_rounds = 8;

bool mirrors(const Trs& t) { return !(t.scale[0] * t.scale[1] * t.scale[2] > 0); }

}  // namespace

/// What must be a node for another reason than its place.
bool Hierarchy::stays_a_node(const Node& n) const {
  if (n.lod || (n.source && animations_.moves(n.source))) return true;
  const Trs t = n.transform == none ? Trs{} : transforms_[n.transform];
  if (n.attachment == Attachment::nothing)
    return mirrors(t) || !(!n.source || scene_.is(n.source, nodes::Transform) || scene_.is(n.source, nodes::Group));
  return !only_places_a_mesh(n, {});  // where it is comes later
}

/// Marks what has to be a node: what is one for itself, what holds such a node, and parts whose place in the nearest
/// node that stays is none that a table can say. `frame` has that place.
bool Hierarchy::find_nodes_that_stay(const Family& family, std::vector<char>& stays, std::vector<Matrix>& frame) const {
  for (std::uint32_t id = 0; id < nodes_.size(); ++id) stays[id] = stays_a_node(nodes_[id]);
  animations_.mark_targets(stays);
  for (const auto& [id, lod] : lods_)
    for (auto level : lod.levels) stays[level] = 1;
  const auto growth = this->growth(family);
  std::vector<double> of_frame(nodes_.size());  // growth of the frame that `frame` leads to
  for (int round = 0; round < most_rounds; ++round) {
    for (std::size_t i = family.order.size(); i-- > 0;)
      if (const auto id = family.order[i]; stays[id] && family.parent[id] != none) stays[family.parent[id]] = 1;
    bool all_fit = true;
    for (auto id : family.order) {
      frame[id] = {};
      if (stays[id]) continue;
      const Node& n = nodes_[id];
      const auto above = family.parent[id];
      of_frame[id] = above == none || stays[above] ? growth[id] : of_frame[above];
      if (above != none) frame[id] = frame[above];
      if (n.transform != none) frame[id] = frame[id] * matrix(transforms_[n.transform]);
      if (n.attachment != Attachment::mesh) continue;
      const auto place = trs_of(frame[id]);
      if (place && only_places_a_mesh(n, *place, of_frame[id])) continue;
      stays[id] = 1;
      all_fit = false;
    }
    if (all_fit) return true;
  }
  return false;
}

void Hierarchy::make_part_rows() {
  const Family family = this->family();
  std::vector<char> stays(nodes_.size());
  std::vector<Matrix> frame(nodes_.size());
  if (!find_nodes_that_stay(family, stays, frame)) return;
  std::vector<std::uint32_t> row(nodes_.size(), none), holder(nodes_.size(), none);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  std::vector<std::vector<std::uint32_t>> in(nodes_.size());  // tables, by the node that holds them
  std::vector<std::uint32_t> in_root;
  for (auto id : family.order) {
    const Node n = nodes_[id];
    const auto above = family.parent[id];
    if (stays[id]) {
      holder[id] = id;
      continue;
    }
    if (above != none) {
      holder[id] = holder[above];
      row[id] = row[above];
    }
    // What is empty but has a name is a row, too.
    if (n.source && !scene_.name(n.source).empty()) row[id] = parts_.add(scene_.name(n.source), row[id]);
    if (n.attachment != Attachment::mesh) continue;
    const auto [at, is_new] =
        known.try_emplace({holder[id], n.attached}, static_cast<std::uint32_t>(instances_.size()));
    if (is_new) {
      instances_.emplace_back();
      (holder[id] == none ? in_root : in[holder[id]]).push_back(static_cast<std::uint32_t>(nodes_.size()));
      nodes_.push_back({.attached = n.attached, .attachment = Attachment::mesh, .instances = at->second});
    }
    Instances& places = instances_[at->second];
    places.sources.push_back(n.source);
    places.places.push_back(*trs_of(frame[id]));
    places.rows.push_back(row[id]);
  }
  std::vector<Mark> marks(nodes_.size(), Mark::nothing);
  std::vector<std::uint32_t> children, roots;
  for (std::uint32_t id = 0; id < stays.size(); ++id) {
    nodes_[id].same_as = none;
    if (!stays[id]) {
      marks[id] = Mark::row;
      continue;
    }
    const auto before = this->children(nodes_[id]);
    const auto first = static_cast<std::uint32_t>(children.size());
    std::ranges::copy_if(before, std::back_inserter(children), [&](auto c) { return stays[c]; });
    children.insert(children.end(), in[id].begin(), in[id].end());
    nodes_[id].first_child = first;
    nodes_[id].n_children = static_cast<std::uint32_t>(children.size()) - first;
  }
  children_ = std::move(children);
  std::erase_if(roots_, [&](auto id) { return !stays[id]; });
  roots_.insert(roots_.end(), in_root.begin(), in_root.end());
  leave_out(marks);
}

}  // namespace wrlkit::gltf

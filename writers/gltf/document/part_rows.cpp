#include <algorithm>
#include <cmath>
#include <map>

#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "writers/gltf/document/place_tables.h"

namespace wrlkit::gltf {
namespace {

constexpr int most_rounds = 8;

bool mirrors(const Trs& t) { return !(t.scale[0] * t.scale[1] * t.scale[2] > 0); }

/// What must be a node for another reason than its place.
bool is_a_node_anyway(const Document& d, const Makers& m, const Node& n) {
  if (n.lod || n.hidden || n.choice != none || (n.source && m.animations.moves(n.source))) return true;
  if (n.attachment == Attachment::nothing)
    return mirrors(d.place(n)) ||
           !(!n.source || m.scene.is(n.source, nodes::Transform) || m.scene.is(n.source, nodes::Group));
  return !only_places_a_mesh(m, n, {});  // where it is comes later
}

/// What has to be a node: what is one for itself, what holds such a node, and parts whose place in the nearest node
/// that stays is none that a table can express.
struct Stays {
  std::vector<char> node;
  std::vector<Matrix> frame;     // of others: their place in the nearest node that stays
  std::vector<double> of_frame;  // growth of the frame that `frame` leads to
};

/// Down from the roots; false when another node has to stay.
bool find_places(const Document& d, const Makers& m, const Family& family, std::span<const double> growth, Stays& s) {
  bool all_fit = true;
  for (auto id : family.order) {
    s.frame[id] = {};
    if (s.node[id]) continue;
    const Node& n = d.nodes[id];
    const auto above = family.parent[id];
    s.of_frame[id] = above == none || s.node[above] ? growth[id] : s.of_frame[above];
    if (above != none) s.frame[id] = s.frame[above];
    if (n.transform != none) s.frame[id] = s.frame[id] * matrix(d.transforms[n.transform]);
    if (n.attachment != Attachment::mesh) continue;
    const auto place = trs_of(s.frame[id]);
    if (place && only_places_a_mesh(m, n, *place, s.of_frame[id])) continue;
    s.node[id] = 1;
    all_fit = false;
  }
  return all_fit;
}

std::optional<Stays> find_nodes_that_stay(const Document& d, const Makers& m, const Family& family) {
  const std::size_t n = d.nodes.size();
  Stays s{std::vector<char>(n), std::vector<Matrix>(n), std::vector<double>(n)};
  for (std::size_t id = 0; id < n; ++id) s.node[id] = is_a_node_anyway(d, m, d.nodes[id]);
  m.animations.mark_targets(s.node);
  for (const auto& [id, lod] : d.lods)
    for (auto level : lod.levels) s.node[level] = 1;
  const auto growth = growth_of(d, family);
  for (int round = 0; round < most_rounds; ++round) {
    for (std::size_t i = family.order.size(); i-- > 0;)
      if (const auto id = family.order[i]; s.node[id] && family.parent[id] != none) s.node[family.parent[id]] = 1;
    if (find_places(d, m, family, growth, s)) return s;
  }
  return std::nullopt;
}

/// The nodes of tables of places, by the node that holds them.
struct Tables {
  std::vector<std::vector<std::uint32_t>> in;
  std::vector<std::uint32_t> in_root;
};

Tables add_tables(Document& d, const Makers& m, PartTable& parts, const Family& family, const Stays& stays) {
  const Scene& scene = m.scene;
  const std::size_t n_nodes = d.nodes.size();
  Tables out{std::vector<std::vector<std::uint32_t>>(n_nodes), {}};
  std::vector<std::uint32_t> row(n_nodes, none), holder(n_nodes, none);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (auto id : family.order) {
    const Node n = d.nodes[id];
    const auto above = family.parent[id];
    if (stays.node[id]) {
      holder[id] = id;
      continue;
    }
    if (above != none) {
      holder[id] = holder[above];
      row[id] = row[above];
    }
    // What is empty but has a name is a row, too.
    const bool tagged = m.extras && has_tags(scene, n.source);
    if (n.source && (tagged || !scene.name(n.source).empty())) row[id] = parts.of_node(scene.name(n.source), row[id]);
    if (tagged) d.tagged_rows.emplace_back(row[id], n.source);
    if (n.attachment != Attachment::mesh) continue;
    const auto [at, is_new] =
        known.try_emplace({holder[id], n.attached}, static_cast<std::uint32_t>(d.instances.size()));
    if (is_new) {
      d.instances.emplace_back();
      (holder[id] == none ? out.in_root : out.in[holder[id]]).push_back(static_cast<std::uint32_t>(d.nodes.size()));
      d.nodes.push_back({.attached = n.attached, .attachment = Attachment::mesh, .instances = at->second});
    }
    Instances& places = d.instances[at->second];
    places.sources.push_back(n.source);
    places.places.push_back(*trs_of(stays.frame[id]));
    places.rows.push_back(row[id]);
  }
  return out;
}

}  // namespace

void make_part_rows(Document& d, const Makers& m, PartTable& parts) {
  const Family family = family_of(d);
  const auto stays = find_nodes_that_stay(d, m, family);
  if (!stays) return;
  const Tables tables = add_tables(d, m, parts, family, *stays);
  std::vector<Mark> marks(d.nodes.size(), Mark::nothing);
  std::vector<std::uint32_t> children;
  for (std::size_t id = 0; id < stays->node.size(); ++id) {
    d.nodes[id].same_as = none;
    if (!stays->node[id]) {
      marks[id] = Mark::row;
      continue;
    }
    const auto first = static_cast<std::uint32_t>(children.size());
    std::ranges::copy_if(d.children_of(d.nodes[id]), std::back_inserter(children),
                         [&](auto c) { return stays->node[c]; });
    children.insert(children.end(), tables.in[id].begin(), tables.in[id].end());
    d.nodes[id].first_child = first;
    d.nodes[id].n_children = static_cast<std::uint32_t>(children.size()) - first;
  }
  d.children = std::move(children);
  std::erase_if(d.roots, [&](auto id) { return !stays->node[id]; });
  d.roots.insert(d.roots.end(), tables.in_root.begin(), tables.in_root.end());
  m.animations.renumber(remove_rows(d, marks));
}

}  // namespace wrlkit::gltf

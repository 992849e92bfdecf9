#include "writers/gltf/document/document.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::gltf {

std::uint32_t Document::add(Node n, std::span<const std::uint32_t> below) {
  n.first_child = static_cast<std::uint32_t>(children.size());
  n.n_children = static_cast<std::uint32_t>(below.size());
  children.insert(children.end(), below.begin(), below.end());
  nodes.push_back(n);
  return static_cast<std::uint32_t>(nodes.size() - 1);
}

std::uint32_t Document::add_transform(const Trs& t, bool always) {
  if (t.identity() && !always) return none;
  transforms.push_back(t);
  return static_cast<std::uint32_t>(transforms.size() - 1);
}

void Document::set_only_child(Node& parent, std::uint32_t child) {
  parent.first_child = static_cast<std::uint32_t>(children.size());
  parent.n_children = 1;
  children.push_back(child);
}

Family family_of(const Document& d) {
  Family f{d.roots, std::vector<std::uint32_t>(d.nodes.size(), none)};
  for (std::size_t i = 0; i < f.order.size(); ++i) {
    const auto id = f.order[i];
    const Node& n = d.nodes[id];
    auto below = [&](std::uint32_t c, std::uint32_t p) {
      f.parent[c] = p;
      f.order.push_back(c);
    };
    for (auto c : d.children_of(n)) below(c, id);
    if (n.lod)
      for (auto l : d.lods.at(id).levels) below(l, f.parent[id]);
  }
  return f;
}

double stretch(const Trs& t) { return std::max({std::abs(t.scale[0]), std::abs(t.scale[1]), std::abs(t.scale[2])}); }

std::vector<double> growth_of(const Document& d, const Family& f) {
  std::vector<double> out(d.nodes.size(), 1);
  for (auto id : f.order)
    if (const auto p = f.parent[id]; p != none) out[id] = out[p] * stretch(d.place(d.nodes[p]));
  return out;
}

std::vector<std::uint32_t> remove_rows(Document& d, std::span<const Mark> marks) {
  std::vector<std::uint32_t> became(d.nodes.size(), none);
  std::vector<Node> left;
  for (std::size_t i = 0; i < d.nodes.size(); ++i) {
    if (marks[i] == Mark::row) continue;
    became[i] = static_cast<std::uint32_t>(left.size());
    left.push_back(d.nodes[i]);
  }
  d.nodes = std::move(left);
  auto renumber = [&](std::span<std::uint32_t> all) {
    for (auto& id : all) id = became[id];
  };
  renumber(d.roots);
  for (Node& n : d.nodes) {
    if (n.same_as != none) n.same_as = became[n.same_as];
    renumber({d.children.data() + n.first_child, n.n_children});
  }
  std::unordered_map<std::uint32_t, Lod> lods;
  for (auto& [id, lod] : d.lods) {
    renumber(lod.levels);
    lods.emplace(became[id], std::move(lod));
  }
  d.lods = std::move(lods);
  return became;
}

}  // namespace wrlkit::gltf

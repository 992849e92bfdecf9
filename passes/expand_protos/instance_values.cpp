#include "passes/expand_protos/instance_values.h"

#include <algorithm>

#include "scenegraph/equal.h"
#include "scenegraph/metadata.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
const InstanceValues::Names& InstanceValues::taken(ProtoId body, bool whole) {
  auto [known, is_new] = taken_.try_emplace(std::uint64_t{body.value} << 1 | whole);
  if (!is_new) return known->second;
  const auto& roots = scene_.proto(body).body.roots;
  const std::span<const NodeId> staying = roots;
  for (NodeId n : reachable(scene_, staying.first(whole ? roots.size() : std::min<std::size_t>(roots.size(), 1))))
    for (const Value& v : scene_.fields(n))
      if (const auto& content = scene_.content(v); content.is) known->second.insert(content.text());
  return known->second;
}

std::vector<InstanceValues::Unused> InstanceValues::unused(NodeId instance, const Prototype& p, bool whole) {
  std::vector<Unused> out;
  const auto& interface = scene_.type(instance).fields;
  const bool has_body = p.state == Prototype::ready;
  for (const Value& v : scene_.fields(instance)) {
    const auto& content = scene_.content(v);
    if (content.is) continue;
    const bool extra = scene_.is_extra(v);
    const auto name = extra ? v.extra->name : interface[v.slot].name;
    if (!extra && equals_default(v, interface[v.slot])) continue;
    const FieldDef* taker = extra || !has_body ? nullptr : prototypes_.field(p.body, name);
    if (!taker || !taken(p.body, whole).contains(taker->name)) out.push_back({name, content});
  }
  return out;
}

void InstanceValues::add(NodeId instance, std::span<const Unused> values) {
  if (values.empty()) return;
  if (const NodeId set = set_of(instance, values)) sets_[instance.value].push_back(set);
}

std::size_t InstanceValues::n_sets(NodeId n) const {
  const auto i = sets_.find(n.value);
  return i == sets_.end() ? 0 : i->second.size();
}

void InstanceValues::add_like(NodeId instance, NodeId other, std::size_t without) {
  if (n_sets(other) <= without) return;
  const auto sets = sets_[other.value];
  auto& all = sets_[instance.value];
  all.insert(all.end(), sets.begin() + static_cast<std::ptrdiff_t>(without), sets.end());
}

NodeId InstanceValues::set_of(NodeId instance, std::span<const Unused> values) {
  std::vector<NodeId> members;
  for (const Unused& u : values)
    if (const NodeId n = member(instance, u)) members.push_back(n);
  if (members.empty()) return {};
  return metadata_set(scene_, {scene_.where(instance), scene_.type(instance).name}, members);
}

/// Null where there is nothing to say, or, which is reported, nothing that can hold it.
NodeId InstanceValues::member(NodeId instance, const Unused& u) {
  if (info(u.value.type).element != Element::node)
    return metadata_of(scene_, {scene_.where(instance), u.name}, u.value);
  const auto held = u.value.node_span();
  if (held.empty()) return {};
  if (!std::ranges::all_of(held, [&](NodeId n) { return scene_.is(n, nodes::X3DMetadataObject); })) {
    diag_.report(Diag::no_vrml_word, scene_.where(instance),
                 "the nodes in " + std::string(scene_.type(instance).name) + "." + std::string(u.name) +
                     ", which the prototype does not use");
    return {};
  }
  return metadata_set(scene_, {scene_.where(instance), u.name}, held);
}

void InstanceValues::finish() {
  std::vector<std::uint32_t> all;
  for (const auto& [n, sets] : sets_) all.push_back(n);
  std::ranges::sort(all);
  for (const auto n : all) {
    const auto& sets = sets_[n];
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) add_metadata(scene_, NodeId{n}, *set);
  }
}

}  // namespace wrlkit

// Nodes are taken by their height: what lies in their fields has been decided before, and counts as its representative.
#include "passes/analysis/representatives.h"

#include <algorithm>
#include <bit>
#include <map>

#include "base/hashing.h"
#include "scenegraph/equal.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

std::uint64_t hash_of(std::string_view s) {
  std::uint64_t h = s.size();
  for (unsigned char c : s) h = mixed(h, c);
  return h;
}

constexpr BaseSet shareable = nodes::X3DAppearanceNode | nodes::X3DAppearanceChildNode | nodes::X3DGeometryNode |
                              nodes::X3DGeometricPropertyNode | nodes::X3DFontStyleNode;

}  // namespace

Representatives::Representatives(const Scene& scene, const Usage& usage, std::span<const NodeId> nodes, bool named)
    : scene_(scene), usage_(usage), named_(named), height_(scene.node_count()), of_(scene.node_count()) {
  std::vector<std::vector<NodeId>> levels;
  for (NodeId n : nodes) {
    if (!may_share(n)) continue;
    const auto h = height(n);
    if (levels.size() < h) levels.resize(h);
    levels[h - 1].push_back(n);
  }
  for (const auto& level : levels) find(level);
}

bool Representatives::may_share(NodeId n) const {
  return scene_.is(n, shareable) && !usage_.touched(n) &&
         std::ranges::none_of(scene_.fields(n), [&](const Value& v) { return v.is || scene_.is_extra(v); });
}

std::uint32_t Representatives::height(NodeId n) {
  if (height_[n.value]) return height_[n.value];
  std::uint32_t below = 0;
  for_each_child(scene_, n, [&](NodeId c) {
    if (may_share(c)) below = std::max(below, height(c));
  });
  return height_[n.value] = below + 1;
}

void Representatives::find(std::span<const NodeId> level) {
  std::vector<std::uint32_t> classes;
  for (NodeId n : level) {
    const auto c = class_of(n);
    if (!classes_[c].first_named && !scene_.name(n).empty()) classes_[c].first_named = n;
    classes.push_back(c);
  }
  std::map<std::pair<std::uint32_t, std::string_view>, NodeId> by_name;
  for (std::size_t i = 0; i < level.size(); ++i) {
    const NodeId n = level[i];
    const Class& c = classes_[classes[i]];
    const bool any = named_ || scene_.name(n).empty();
    of_[n.value] = any ? (c.first_named ? c.first_named : c.first)
                       : by_name.try_emplace({classes[i], scene_.name(n)}, n).first->second;
  }
}

std::uint32_t Representatives::class_of(NodeId n) {
  auto [head, fresh] = by_hash_.try_emplace(hash(n), none);
  for (auto c = head->second; c != none; c = classes_[c].next)
    if (same(classes_[c].first, n)) return c;
  classes_.push_back({n, {}, head->second});
  return head->second = static_cast<std::uint32_t>(classes_.size() - 1);
}

bool Representatives::is_default(NodeId n, const Value& v) const {
  return equals_default(v, scene_.type(n).fields[v.slot]);
}

/// Fields may be in any order.
std::uint64_t Representatives::hash(NodeId n) const {
  std::uint64_t h = mixed(scene_.type_id(n).value, hash_of(folder(n)));
  for (const Value& v : scene_.fields(n))
    if (!is_default(n, v)) h += mixed(hash(v), v.slot);
  return h;
}

std::uint64_t Representatives::hash(const Value& v) const {
  std::uint64_t h = v.count;
  const auto& type = info(v.type);
  switch (type.element) {
    case Element::number:
      for (double d : v.number_span()) h = mixed(h, std::bit_cast<std::uint64_t>(d == 0 ? 0.0 : d));
      break;
    case Element::integer:
    case Element::image:
      for (auto i : v.integer_span()) h = mixed(h, static_cast<std::uint32_t>(i));
      break;
    case Element::node:
      for (NodeId c : v.node_span()) h = mixed(h, of(c).value);
      break;
    case Element::text:
      if (!type.multiple) return mixed(h, hash_of(v.text()));
      for (auto s : v.text_span()) h = mixed(h, hash_of(s));
  }
  return h;
}

bool Representatives::same(NodeId a, NodeId b) const {
  if (scene_.type_id(a) != scene_.type_id(b) || folder(a) != folder(b)) return false;
  std::size_t in_a = 0, in_b = 0;
  for (const Value& v : scene_.fields(b)) in_b += !is_default(b, v);
  for (const Value& v : scene_.fields(a)) {
    if (is_default(a, v)) continue;
    const Value* other = scene_.find(b, v.slot);
    if (!other || !same(v, *other)) return false;
    ++in_a;
  }
  return in_a == in_b;
}

bool Representatives::same(const Value& a, const Value& b) const {
  if (a.type != b.type || info(a.type).element != Element::node) return equal_plain(a, b);
  return std::ranges::equal(a.node_span(), b.node_span(), [&](NodeId x, NodeId y) { return of(x) == of(y); });
}

/// A relative url is relative to the file that the node was read from.
std::string_view Representatives::folder(NodeId n) const {
  if (!scene_.sources || !scene_.is(n, nodes::X3DUrlObject)) return {};
  const auto file = scene_.sources->file(scene_.where(n).begin);
  return file.substr(0, file.rfind('/') + 1);
}

}  // namespace wrlkit

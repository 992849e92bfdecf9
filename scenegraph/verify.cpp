#include "scenegraph/verify.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <unordered_map>

#include "base/parallel.h"
#include "base/text/bit_mask.h"
#include "scenegraph/driven.h"
#include "scenegraph/nodes.h"
#include "scenegraph/range_text.h"
#include "scenegraph/repair.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

class ValueCheck {
 public:
  ValueCheck(const Scene& scene, Diagnostics& diag) : scene_(scene), diag_(diag) {}

  void node(NodeId n) {
    for (auto& v : scene_.fields(n)) value(n, v);
  }

  void value(NodeId n, const Value& v) {
    if (const auto& c = scene_.content(v); !can_be_written(c)) report_repair(scene_, n, c, diag_);
    if (scene_.is_extra(v) || v.is) return;
    const auto& f = scene_.type(n).fields[v.slot];
    if (f.range.bounded()) range(n, f, v);
    if (f.kinds.empty()) return;
    if (info(f.type).element == Element::text)
      words(n, f, v);
    else
      children(n, f, v);
  }

 private:
  void range(NodeId n, const FieldDef& f, const Value& v) {
    // pi/2 is printed as 1.5708, which is a little more.
    const double rounded = f.unit == "angle" ? 5e-5 : 0;
    for (double d : v.number_span())
      if (!f.range.contains(d) && !f.range.contains(d - rounded) && !f.range.contains(d + rounded))
        return diag_.report(Diag::out_of_range, scene_.where(n), scene_.type(n).name, f.name, d, range_text(f.range));
    if (info(f.type).element != Element::integer) return;
    for (auto i : v.integer_span())
      if (!f.range.contains(i))
        return diag_.report(Diag::out_of_range, scene_.where(n), scene_.type(n).name, f.name, i, range_text(f.range));
  }

  void words(NodeId n, const FieldDef& f, const Value& v) {
    auto check = [&](std::string_view w) {
      if (std::ranges::find(f.kinds, w) == f.kinds.end())
        diag_.report(Diag::unknown_word, scene_.where(n), w, scene_.type(n).name, f.name);
    };
    if (info(v.type).multiple)
      std::ranges::for_each(v.text_span(), check);
    else if (v.type == FieldType::SFBitMask)
      for_each_bit(v.text(), check);
    else
      check(v.text());
  }

  /// A prototype is what the first node of its body is; what an EXTERNPROTO or an unknown node is, is not known here.
  const NodeType* kind_of(NodeId n) const {
    const NodeType* t = &scene_.type(n);
    for (int depth = 0; t->kind == NodeKind::proto && depth < 100; ++depth) {
      const auto& p = scene_.proto(t->proto);
      if (p.external || p.body.roots.empty()) return nullptr;
      t = &scene_.type(p.body.roots[0]);
    }
    return t->kind == NodeKind::unknown || t->kind == NodeKind::proto ? nullptr : t;
  }

  void children(NodeId n, const FieldDef& f, const Value& v) {
    for (NodeId c : v.node_span()) {
      auto* t = c ? kind_of(c) : nullptr;
      if (t && t->dialects == static_cast<DialectSet>(Dialect::vrml1)) continue;  // it will be another node there
      if (t && !accepts(f, *t))
        diag_.report(Diag::wrong_child, scene_.where(c), t->name, scene_.type(n).name, f.name_in(scene_.dialect()));
    }
  }

  /// What was accepted is remembered: the same few pairs come for all nodes of a plant.
  bool accepts(const FieldDef& f, const NodeType& t) {
    const auto known = std::pair(&f, &t);
    auto& place = accepted_[(reinterpret_cast<std::uintptr_t>(&f) / 16 + reinterpret_cast<std::uintptr_t>(&t) / 16) %
                            accepted_.size()];
    if (place == known) return true;
    if (!f.accepts(t)) return false;
    place = known;
    return true;
  }

  const Scene& scene_;
  Diagnostics& diag_;
  std::array<std::pair<const FieldDef*, const NodeType*>, 61> accepted_{};
};

/// On all threads, where the scene is large: there is mostly nothing, and what there is must be reported in order.
bool nothing_to_say(const Scene& scene, std::span<const NodeId> all) {
  constexpr std::size_t at_once = 16 * 1024, from = 4 * at_once;
  if (all.size() < from || only_one_thread()) return false;
  std::atomic<bool> good = true;
  parallel_for(all.size() / at_once + 1, [&](std::size_t i) {
    Diagnostics unheard;
    ValueCheck check(scene, unheard);
    const auto begin = i * at_once;
    for (const NodeId n : all.subspan(begin, std::min(at_once, all.size() - begin))) {
      if (!good) return;
      check.node(n);
    }
    if (!unheard.messages().empty()) good = false;
  });
  return good;
}

FieldType event_type(const Scene& s, NodeId n, std::string_view event) {
  auto slot = s.type(n).find(event, s.dialect(), true);
  return slot ? s.type(n).fields[*slot].type : FieldType::verbatim;
}

class Invariants {
 public:
  Invariants(const Scene& s, Level level, Diagnostics& diag) : s_(s), level_(level), diag_(diag) {}

  bool run() {
    for (NodeId n{0}; n.value < s_.node_count(); ++n.value) ids(n);
    scope(s_.main);
    for (std::uint32_t i = 0; i < s_.proto_count(); ++i) prototype(s_.proto(ProtoId{i}));
    if (!good_) return false;
    cycles();
    if (level_ == Level::mesh) driven_ = driven_geometry(s_);
    if (level_ != Level::authored)
      for (NodeId n : reachable(s_, s_.main)) expanded(n);
    return good_;
  }

 private:
  void breach(NodeId n, const std::string& what) {
    diag_.report(Diag::verify, s_.where(n), std::string(s_.type(n).name) + ": " + what);
    good_ = false;
  }
  void breach(const std::string& what) {
    diag_.report(Diag::verify, Span{}, what);
    good_ = false;
  }

  bool is_node(NodeId n) const { return n && n.value < s_.node_count(); }
  bool is_type(TypeId t) const { return t && t.value < builtin_nodes().size() + s_.own_types().size(); }

  void ids(NodeId n) {
    if (!is_type(s_.type_id(n))) return breach("a node of a type that is not there");
    if (s_.type(n).kind == NodeKind::proto && s_.type(n).proto.value >= s_.proto_count())
      breach(n, "an instance of a prototype that is not there");
    auto& slots = slots_;
    slots.clear();
    for (auto& v : s_.fields(n)) {
      if (!s_.is_extra(v)) slots.push_back(v.slot);
      if (!s_.is_extra(v) && v.slot >= s_.type(n).fields.size())
        breach(n, "a field that its type does not have");
      else if (!s_.is_extra(v) && v.type != s_.type(n).fields[v.slot].type)
        breach(n, "field " + std::string(s_.field_name(n, v)) + " has another type");
      for (NodeId c : s_.content(v).node_span())
        if (c && !is_node(c)) breach(n, "a child that is not a node");
    }
    const bool is_sorted = std::ranges::is_sorted(slots);
    if (s_.fields(n).size() >= NodeType::many_fields && !is_sorted)
      breach(n, "many fields that are not in their order");
    if (!is_sorted) std::ranges::sort(slots);
    if (std::ranges::adjacent_find(slots) != slots.end()) breach(n, "two values of one field");
  }

  void scope(const Scope& scope) {
    for (NodeId n : scope.roots)
      if (!is_node(n)) breach("a root that is not a node");
    for (const auto& r : scope.routes)
      if (!is_node(r.from) || !is_node(r.to) || r.event_out.empty() || r.event_in.empty())
        breach("a ROUTE without its nodes or events");
    for (const auto& i : scope.imports)
      if (!is_node(i.inline_node) || !is_node(i.node)) breach("an IMPORT without its nodes");
    for (const auto& e : scope.exports)
      if (!is_node(e.node)) breach("an EXPORT without its node");
    for (ProtoId p : scope.protos)
      if (p.value >= s_.proto_count()) breach("a declaration of a prototype that is not there");
  }

  void prototype(const Proto& p) {
    if (!is_type(p.type) || s_.type(p.type).kind != NodeKind::proto) return breach("a prototype without an interface");
    scope(p.body);
    for (const auto& f : s_.type(p.type).fields)
      for (NodeId n : f.default_value.node_span())
        if (n && !is_node(n)) breach("a default that is not a node");
  }

  /// What a Script or an instance may hold is not specified (4.12.8); all others are followed.
  bool goes_down(NodeId n) const {
    const auto kind = s_.type(n).kind;
    return kind != NodeKind::script && kind != NodeKind::proto && s_.type(n).name != "Script";
  }

  void cycles() {
    enum : char { fresh, open, done };
    std::vector<char> state(s_.node_count(), fresh);
    std::vector<NodeId> path;
    for (NodeId start{0}; start.value < s_.node_count(); ++start.value) {
      path.push_back(start);
      while (!path.empty()) {
        const NodeId n = path.back();
        if (state[n.value] != fresh) {
          state[n.value] = done;
          path.pop_back();
          continue;
        }
        state[n.value] = open;
        if (!goes_down(n)) continue;
        for_each_child(s_, n, [&](NodeId c) {
          if (state[c.value] == open) breach(n, "a node that is below itself");
          if (state[c.value] == fresh) path.push_back(c);
        });
      }
    }
  }

  void expanded(NodeId n) {
    for (auto& v : s_.fields(n))
      if (s_.content(v).is) breach(n, "IS outside of a prototype");
    if (s_.type(n).kind == NodeKind::proto && !s_.proto(s_.type(n).proto).external) breach(n, "a prototype instance");
    if (level_ == Level::mesh && !driven_[n.value] && s_.is(n, nodes::X3DGeometryNode) &&
        !s_.is(n, nodes::IndexedFaceSet) && !s_.is(n, nodes::IndexedLineSet) && !s_.is(n, nodes::PointSet))
      breach(n, "geometry that is no mesh");
  }

  const Scene& s_;
  Level level_;
  Diagnostics& diag_;
  std::vector<char> driven_;  // by node, at the level of meshes
  std::vector<std::uint16_t> slots_;
  bool good_ = true;
};

}  // namespace

void check_value(const Scene& scene, NodeId n, const Value& value, Diagnostics& diag) {
  ValueCheck(scene, diag).value(n, value);
}

void check_values(const Scene& scene, Diagnostics& diag) {
  const auto all = all_nodes(scene);
  if (!nothing_to_say(scene, all)) {
    ValueCheck check(scene, diag);
    for (NodeId n : all) check.node(n);
  }
  for_each_route(scene, [&](const Route& r) {
    auto a = event_type(scene, r.from, r.event_out), b = event_type(scene, r.to, r.event_in);
    if (a != b && a != FieldType::verbatim && b != FieldType::verbatim)
      diag.report(Diag::route_types, scene.where(r.from), info(a).name, info(b).name);
  });
}

bool verify(const Scene& scene, Level level, Diagnostics& diag) { return Invariants(scene, level, diag).run(); }

}  // namespace wrlkit

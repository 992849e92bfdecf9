#include "scenegraph/builder.h"

#include "scenegraph/browser_nodes.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit {

NodeId SceneBuilder::open(TypeId type, std::string_view def_name, Span where) {
  NodeId n = scene_.add(type, where);
  if (!def_name.empty()) {
    scene_.set_name(n, def_name);
    scopes_.back().defs[scene_.name(n)] = n;
  }
  open_.push_back({n, fields_.size(), {}, {}, {}});
  return n;
}

void SceneBuilder::close() {
  auto& o = open_.back();
  if (!o.more.empty()) append_all(o);
  if (scene_.dialect() == Dialect::x3d && current_type().kind == NodeKind::builtin) add_x3d_defaults(o);
  std::span<const Value> fields(fields_.data() + o.first_field, fields_.size() - o.first_field);
  if (o.own.empty()) {
    scene_.set_fields(o.node, fields);
  } else {
    NodeType t = scene_.type(o.node);
    t.kind = NodeKind::script;
    std::vector<FieldDef> all(t.fields.begin(), t.fields.end());
    all.insert(all.end(), o.own.begin(), o.own.end());
    scene_.become(o.node, scene_.add_type(t, all), fields);
  }
  fields_.resize(o.first_field);
  open_.pop_back();
}

/// Defaults that are not those of the table are written out, so that all scenes mean the same.
void SceneBuilder::add_x3d_defaults(Open& o) {
  for (const auto& f : current_type().fields)
    if (f.x3d_from && scene_.x3d.version >= f.x3d_from && !find_field(o, f.x3d_default.slot))
      fields_.push_back(f.x3d_default);
}

/// The field of that slot, or null. Where there are many, an index grows with them.
Value* SceneBuilder::find_field(Open& o, std::uint16_t slot) {
  auto fields = std::span(fields_).subspan(o.first_field);
  if (fields.size() < NodeType::many_fields) {
    auto i = std::ranges::find(fields, slot, &Value::slot);
    return i == fields.end() ? nullptr : &*i;
  }
  for (; o.n_indexed < fields.size(); ++o.n_indexed) {
    const auto s = fields[o.n_indexed].slot;
    if (s == Value::extra_slot) continue;
    if (s >= o.by_slot.size()) o.by_slot.resize(s + std::size_t{1});
    o.by_slot[s] = static_cast<std::uint32_t>(o.n_indexed + 1);
  }
  return slot < o.by_slot.size() && o.by_slot[slot] ? &fields[o.by_slot[slot] - 1] : nullptr;
}

void SceneBuilder::field(Value v, Span where) {
  if (v.slot != Value::extra_slot)
    if (Value* old = find_field(open_.back(), v.slot)) {
      auto& own = open_.back().own;
      auto builtin = current_type().fields;
      const bool lists = v.type == FieldType::MFNode && old->type == FieldType::MFNode && !v.is && !old->is;
      diag_.report(Diag::duplicate_field, where,
                   v.slot < builtin.size() ? builtin[v.slot].name : own[v.slot - builtin.size()].name,
                   lists ? "all nodes count" : "the last one counts");
      if (!lists)
        *old = v;
      else
        for (NodeId n : v.node_span()) append_child(v.slot, n);
      return;
    }
  if (fields_.size() - open_.back().first_field >= most_fields)
    return diag_.report(Diag::expansion_limit, where, most_fields, "fields");
  // Nodes that came before this list outside of any field stand before those in it.
  auto& more = open_.back().more;
  if (v.type == FieldType::MFNode && !v.is &&
      std::ranges::any_of(more, [&](const auto& m) { return m.first == v.slot; }))
    for (NodeId n : v.node_span()) append_child(v.slot, n);
  else
    fields_.push_back(v);
}

/// Puts the nodes that were appended behind those of the fields, each list once.
void SceneBuilder::append_all(Open& o) {
  std::ranges::stable_sort(o.more, {}, &std::pair<std::uint16_t, NodeId>::first);
  for (auto i = o.more.begin(); i != o.more.end();) {
    const auto slot = i->first;
    Value* old = find_field(o, slot);
    std::vector<NodeId> all;
    if (old) all.assign(old->node_span().begin(), old->node_span().end());
    for (; i != o.more.end() && i->first == slot; ++i) all.push_back(i->second);
    Value v = scene_.make(FieldType::MFNode, slot, all);
    if (old)
      *old = v;
    else
      fields_.push_back(v);
  }
}

std::optional<std::uint16_t> SceneBuilder::declare(FieldDef f, Span where) {
  auto& own = open_.back().own;
  if (own.size() >= most_fields) {
    diag_.report(Diag::expansion_limit, where, most_fields, "fields");
    return std::nullopt;
  }
  own.push_back(f);
  return static_cast<std::uint16_t>(current_type().fields.size() + own.size() - 1);
}

NodeId SceneBuilder::defined(std::string_view name) const {
  auto& defs = scopes_.back().defs;
  auto i = defs.find(name);
  return i == defs.end() ? NodeId{} : i->second;
}

NodeId SceneBuilder::use(std::string_view name, Span where) {
  NodeId n = defined(name);
  if (!n) {
    diag_.report(Diag::undefined_use, where, name);
    return n;
  }
  bool inside = std::ranges::binary_search(open_, n.value, {}, [](const Open& o) { return o.node.value; });
  // A Script may hold the node it is in (4.12.8), and what a prototype does with a node is known only when it is
  // expanded.
  if (inside && current_type().kind != NodeKind::proto && current_type().name != "Script") {
    diag_.report(Diag::use_cycle, where, name);
    return NodeId{};
  }
  return n;
}

Scope SceneBuilder::close_scope() {
  const auto links = std::move(scopes_.back().links);
  for (auto& l : links)
    if (!try_link(l))
      diag_.report(Diag::undefined_import, l.where, l.import ? "IMPORT" : "EXPORT", l.node, "not defined");
  auto forward = std::move(scopes_.back().forward);
  for (auto& r : forward)
    if (!try_route(r)) diag_.report(Diag::undefined_route, r.where, routed(r.from) ? r.to : r.from);
  Scope s = std::move(scopes_.back().scope);
  scopes_.pop_back();
  return s;
}

void SceneBuilder::route(std::string_view from, std::string_view event_out, std::string_view to,
                         std::string_view event_in, Span where) {
  Pending r{scene_.keep(from), scene_.keep(event_out), scene_.keep(to), scene_.keep(event_in), where};
  if (!try_route(r)) scopes_.back().forward.push_back(r);
}

bool SceneBuilder::try_route(const Pending& r) {
  NodeId from = routed(r.from), to = routed(r.to);
  if (!from || !to) return false;
  check_event(from, r.event_out, true, r.where);
  check_event(to, r.event_in, false, r.where);
  if (!r.event_out.empty() && !r.event_in.empty())
    scopes_.back().scope.routes.push_back({from, to, r.event_out, r.event_in});
  return true;
}

NodeId SceneBuilder::routed(std::string_view name) const {
  if (NodeId n = defined(name)) return n;
  auto& imported = scopes_.back().imported;
  auto i = imported.find(name);
  return i == imported.end() ? NodeId{} : i->second;
}

void SceneBuilder::import_name(std::string_view inline_name, std::string_view exported, std::string_view name,
                               Span where) {
  link({true, scene_.keep(inline_name), scene_.keep(exported), scene_.keep(name), where});
}

void SceneBuilder::export_name(std::string_view node, std::string_view name, Span where) {
  link({false, scene_.keep(node), {}, scene_.keep(name), where});
}

void SceneBuilder::link(const Link& l) {
  if (!try_link(l)) scopes_.back().links.push_back(l);
}

bool SceneBuilder::try_link(const Link& l) {
  Names& s = scopes_.back();
  const NodeId n = l.import ? defined(l.node) : routed(l.node);
  if (!n || l.name.empty() || (l.import && l.exported.empty())) return false;
  const auto* keyword = l.import ? "IMPORT" : "EXPORT";
  if (l.import && !scene_.is(n, nodes::Inline))
    diag_.report(Diag::undefined_import, l.where, keyword, l.node, "not an Inline");
  else if (l.import ? static_cast<bool>(routed(l.name)) : !s.exported.insert(l.name).second)
    diag_.report(Diag::duplicate_import, l.where, keyword, l.name);
  else if (l.import)
    s.scope.imports.push_back({n, l.exported, s.imported[l.name] = scene_.add_stand_in(l.name, l.where)});
  else
    s.scope.exports.push_back({n, l.name});
  return true;
}

// The fields of a Script that is still open are not in its type yet; such a ROUTE is taken as it is.
void SceneBuilder::check_event(NodeId n, std::string_view event, bool out, Span where) {
  const auto& t = scene_.type(n);
  const bool is_open = std::ranges::any_of(open_, [&](const Open& o) { return o.node == n; });
  if (!event.empty() && (is_open || t.takes_any_field())) return;
  auto slot = t.find(event, scene_.dialect(), true);
  if (slot) {
    auto a = t.fields[*slot].access;
    if (a == Access::inout || a == (out ? Access::out : Access::in) ||
        (a == Access::init && scene_.dialect() == Dialect::x3d))
      return;
  }
  diag_.report(Diag::unknown_event, where, t.name, event);
}

TypeId SceneBuilder::proto_type(std::string_view name, std::span<const FieldDef> fields) {
  NodeType t;
  t.name = scene_.keep(name);
  t.kind = NodeKind::proto;
  t.dialects = 0xff;
  return scene_.add_type(t, fields);
}

ProtoId SceneBuilder::declare_proto(Proto p, Span where) {
  auto name = scene_.type(p.type).name;
  TypeId type = p.type;
  p.roots_before = static_cast<std::uint32_t>(scopes_.back().scope.roots.size());
  ProtoId id = scene_.add_proto(std::move(p));
  scene_.set_type_proto(type, id);
  if (!scopes_.back().protos.emplace(name, type).second) {
    diag_.report(Diag::duplicate_proto, where, name);
    scopes_.back().protos[name] = type;
  }
  scopes_.back().scope.protos.push_back(id);
  return id;
}

TypeId SceneBuilder::known_type(std::string_view name) const {
  for (auto s = scopes_.rbegin(); s != scopes_.rend(); ++s)
    if (!s->protos.empty())
      if (auto i = s->protos.find(name); i != s->protos.end()) return i->second;
  return find_builtin(name, scene_.dialect());
}

TypeId SceneBuilder::type(std::string_view name, Span where) {
  if (TypeId t = known_type(name)) return t;
  if (TypeId t = foreign_type(name, Dialect::x3d, where)) return t;
  const bool of_browser = find_browser_node(name);
  if (!of_browser)
    if (TypeId t = vrml1_type(name, where)) return t;
  if (!unknown_.contains(name) && !of_browser) diag_.report(Diag::unknown_node, where, name);
  return unknown_type(name);
}

TypeId SceneBuilder::vrml1_type(std::string_view name, Span where) { return foreign_type(name, Dialect::vrml1, where); }

TypeId SceneBuilder::foreign_type(std::string_view name, Dialect dialect, Span where) {
  if (scene_.dialect() != Dialect::vrml97) return {};
  const TypeId t = find_builtin(name, dialect);
  if (t && foreign_.insert(t.value).second)
    diag_.report(Diag::dialect_node, where, name, dialect == Dialect::x3d ? "X3D" : "VRML 1.0", "VRML97");
  return t;
}

TypeId SceneBuilder::unknown_type(std::string_view name) {
  if (auto i = unknown_.find(name); i != unknown_.end()) return i->second;
  NodeType t;
  t.name = scene_.keep(name);
  t.kind = NodeKind::unknown;
  t.dialects = static_cast<DialectSet>(scene_.dialect());
  return unknown_[t.name] = scene_.add_type(t, {});
}

}  // namespace wrlkit

#include "scenegraph/scene.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace wrlkit {

Scene::Scene() : sources(std::make_shared<Sources>()) {}

NodeId Scene::add(TypeId type, Span where) {
  nodes_.push_back({.type = type, .offset = where.begin});
  return NodeId{static_cast<std::uint32_t>(nodes_.size() - 1)};
}

NodeId Scene::add_stand_in(std::string_view name, Span where) {
  if (!stand_in_) {
    NodeType t;
    t.name = "IMPORT";
    t.kind = NodeKind::unknown;
    t.dialects = static_cast<DialectSet>(Dialect::x3d);
    stand_in_ = add_type(t, {});
  }
  const NodeId n = add(stand_in_, where);
  set_name(n, name);
  return n;
}

const NodeType& Scene::type(TypeId t) const {
  auto rows = builtin_nodes();
  return t.value < rows.size() ? rows[t.value] : types_[t.value - rows.size()];
}

void Scene::set_name(NodeId n, std::string_view name) {
  if (name.empty()) {
    nodes_[n.value].name = 0;
    return;
  }
  nodes_[n.value].name = static_cast<std::uint32_t>(names_.size());
  names_.push_back(arena().copy(name));
}

const Value* Scene::find(NodeId n, std::uint16_t slot) const {
  auto all = fields(n);
  auto i = all.size() < NodeType::many_fields ? std::ranges::find(all, slot, &Value::slot)
                                              : std::ranges::lower_bound(all, slot, {}, &Value::slot);
  return i != all.end() && i->slot == slot ? &*i : nullptr;
}

const Value& Scene::value(NodeId n, std::uint16_t slot) const {
  static const Value none;  // of no type, so that Scene::get gives the default of its key
  if (auto* v = find(n, slot)) return *v;
  const auto& defaults = type(n).fields;
  assert(slot < defaults.size() && "a key of another node type");
  return slot < defaults.size() ? defaults[slot].default_value : none;
}

std::string_view Scene::field_name(NodeId n, const Value& v) const {
  return v.slot == Value::extra_slot ? v.extra->name : type(n).fields[v.slot].name;
}

void Scene::set_fields(NodeId n, std::span<const Value> fields) {
  auto& node = nodes_[n.value];
  if (fields.size() <= node.n_fields) {
    std::ranges::copy(fields, fields_.begin() + node.first_field);
  } else {
    std::vector<Value> copy;  // `fields` may lie in fields_, which is about to grow
    if (!fields_.empty() && fields.data() >= fields_.data() && fields.data() < fields_.data() + fields_.size()) {
      copy.assign(fields.begin(), fields.end());
      fields = copy;
    }
    node.first_field = static_cast<std::uint32_t>(fields_.size());
    fields_.insert(fields_.end(), fields.begin(), fields.end());
  }
  node.n_fields = static_cast<std::uint32_t>(fields.size());
  if (node.n_fields >= NodeType::many_fields)
    std::ranges::stable_sort(std::span(fields_).subspan(node.first_field, node.n_fields), {}, &Value::slot);
}

void Scene::set(NodeId n, Value v) {
  assert(v.slot == Value::extra_slot || v.slot < type(n).fields.size());
  if (v.slot != Value::extra_slot)
    if (auto* old = find(n, v.slot)) {
      fields_[static_cast<std::size_t>(old - fields_.data())] = v;
      return;
    }
  auto& node = nodes_[n.value];
  if (node.first_field + node.n_fields == fields_.size() && node.n_fields + 1 < NodeType::many_fields &&
      node.n_fields > 0) {  // the last ones there are: k new fields in a row take k values, not k (k + 1) / 2
    fields_.push_back(v);
    ++node.n_fields;
    return;
  }
  auto now = fields(n);
  std::vector<Value> next(now.begin(), now.end());
  next.push_back(v);
  set_fields(n, next);
}

void Scene::unset(NodeId n, std::uint16_t slot) {
  std::vector<Value> next;
  for (auto& v : fields(n))
    if (v.slot != slot) next.push_back(v);
  set_fields(n, next);
}

void Scene::become(NodeId n, TypeId type, std::span<const Value> fields) {
  nodes_[n.value].type = type;
  set_fields(n, fields);
}

namespace {

Value head(FieldType type, std::uint16_t slot, std::size_t count) {
  Value v;
  v.type = type;
  v.slot = slot;
  v.count = static_cast<std::uint32_t>(count);
  return v;
}

/// What the numbers of another scene are in the one that it becomes part of, which had so many of each.
struct Renumbered {
  std::uint32_t n_nodes, n_types, n_protos;

  NodeId node(NodeId n) const { return n ? NodeId{n.value + n_nodes} : n; }
  TypeId type(TypeId t) const { return t.value < builtin_nodes().size() ? t : TypeId{t.value + n_types}; }
  ProtoId proto(ProtoId p) const { return ProtoId{p.value + n_protos}; }
  Scope scope(const Scope& s) const {
    Scope o;
    for (auto n : s.roots) o.roots.push_back(node(n));
    for (auto r : s.routes) o.routes.push_back({node(r.from), node(r.to), r.event_out, r.event_in});
    for (auto p : s.protos) o.protos.push_back(proto(p));
    for (auto i : s.imports) o.imports.push_back({node(i.inline_node), i.exported, node(i.node)});
    for (auto e : s.exports) o.exports.push_back({node(e.node), e.name});
    return o;
  }
};

}  // namespace

Value Scene::make(FieldType t, std::uint16_t slot, std::span<const double> a) {
  const auto& i = info(t);
  assert(i.element == Element::number && "numbers for a field of something else");
  auto v = head(t, slot, i.multiple ? a.size() / i.arity : 1);
  if (!i.multiple && i.arity == 1) {
    v.number = a.empty() ? 0 : a[0];
  } else if (!i.multiple && a.size() < i.arity) {
    double* to = arena().allocate<double>(i.arity);
    std::fill(std::ranges::copy(a, to).out, to + i.arity, 0.0);
    v.numbers = to;
  } else {
    v.numbers = arena().copy(a);
  }
  return v;
}

Value Scene::make(FieldType t, std::uint16_t slot, std::span<const std::int32_t> a) {
  auto v = head(t, slot, a.size());
  v.integers = arena().copy(a);
  return v;
}

Value Scene::make(FieldType t, std::uint16_t slot, std::span<const std::string_view> a) {
  auto v = head(t, slot, a.size());
  std::string_view* to = arena().allocate<std::string_view>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) to[i] = arena().copy(a[i]);
  v.texts = to;
  return v;
}

Value Scene::make(FieldType t, std::uint16_t slot, std::span<const NodeId> a) {
  auto v = head(t, slot, a.size());
  v.nodes = arena().copy(a);
  return v;
}

Value Scene::make(FieldType t, std::uint16_t slot, std::string_view s) {
  assert(info(t).element == Element::text && "text for a field of something else");
  if (info(t).multiple) return make(t, slot, std::span<const std::string_view>(&s, 1));
  auto v = head(t, slot, s.size());
  v.chars = arena().copy(s).data();
  return v;
}

Value Scene::make(FieldType t, std::uint16_t slot, double d) {
  const auto& i = info(t);
  assert(i.element == Element::number && "a real number for a field of something else");
  if (i.multiple || i.arity > 1) return make(t, slot, std::span<const double>(&d, 1));
  auto v = head(t, slot, 1);
  v.number = d;
  return v;
}

Value Scene::make(FieldType t, std::uint16_t slot, bool b) { return make(t, slot, std::int32_t{b}); }

Value Scene::make(FieldType t, std::uint16_t slot, std::int32_t i) {
  const auto& field = info(t);
  if (field.element == Element::number) return make(t, slot, static_cast<double>(i));
  if (field.multiple || field.element == Element::image) return make(t, slot, std::span<const std::int32_t>(&i, 1));
  auto v = head(t, slot, 1);
  v.integer = i;
  return v;
}

Value Scene::make_whole(FieldType t, std::uint16_t slot, std::int64_t i) {
  if (info(t).element == Element::number) return make(t, slot, static_cast<double>(i));
  constexpr auto least = std::numeric_limits<std::int32_t>::min(), most = std::numeric_limits<std::int32_t>::max();
  return make(t, slot, static_cast<std::int32_t>(std::clamp<std::int64_t>(i, least, most)));
}

Value Scene::make(FieldType t, std::uint16_t slot, NodeId n) {
  if (info(t).multiple) return make(t, slot, std::span<const NodeId>(&n, n ? 1 : 0));
  auto v = head(t, slot, 1);
  v.node = n;
  return v;
}

Value Scene::make_extra(std::string_view name, Value content) {
  auto* e = arena().allocate<ExtraField>(1);
  content.slot = Value::extra_slot;
  *e = {arena().copy(name), content};
  Value v = head(content.type, Value::extra_slot, 1);
  v.extra = e;
  return v;
}

TypeId Scene::add_type(NodeType t, std::span<const FieldDef> fields) {
  t.fields = {arena().copy(fields), fields.size()};
  t.by_name = {};
  if (fields.size() >= NodeType::many_fields) {
    auto* slots = arena().allocate<std::uint16_t>(fields.size());
    std::iota(slots, slots + fields.size(), std::uint16_t{0});
    std::stable_sort(slots, slots + fields.size(), [&](auto a, auto b) { return fields[a].name < fields[b].name; });
    t.by_name = {slots, fields.size()};
  }
  types_.push_back(t);
  return TypeId{static_cast<std::uint32_t>(builtin_nodes().size() + types_.size() - 1)};
}

ProtoId Scene::add_proto(Proto p) {
  protos_.push_back(std::move(p));
  return ProtoId{static_cast<std::uint32_t>(protos_.size() - 1)};
}

Scope Scene::import(const Scene& other) {
  if (&other == this) return import(Scene(other));
  const auto f0 = static_cast<std::uint32_t>(fields_.size());
  const auto name0 = static_cast<std::uint32_t>(names_.size());
  const Renumbered now{static_cast<std::uint32_t>(nodes_.size()), static_cast<std::uint32_t>(types_.size()),
                       static_cast<std::uint32_t>(protos_.size())};
  auto value = [&](auto& self, Value v) -> Value {
    if (v.slot == Value::extra_slot && v.extra && info(v.extra->value.type).element == Element::node &&
        !v.extra->value.is)
      return make_extra(v.extra->name, self(self, [&] {
                          Value c = v.extra->value;
                          c.slot = 0;
                          return c;
                        }()));
    if (v.slot == Value::extra_slot || v.is || info(v.type).element != Element::node) return v;
    if (!info(v.type).multiple) {
      v.node = now.node(v.node);
      return v;
    }
    NodeId* to = arena().allocate<NodeId>(v.count);
    for (std::size_t i = 0; i < v.count; ++i) to[i] = now.node(v.nodes[i]);
    v.nodes = to;
    return v;
  };

  const std::uint32_t shift = sources->add_all(other.sources);
  auto place = [&](std::uint32_t offset) {
    return offset == Span::nowhere || shift == Span::nowhere ? Span::nowhere : offset + shift;
  };

  arenas_.share_all(other.arenas_);
  names_.insert(names_.end(), other.names_.begin() + 1, other.names_.end());
  for (auto n : other.nodes_) {
    n.type = now.type(n.type);
    if (n.name) n.name += name0 - 1;
    n.first_field += f0;
    n.offset = place(n.offset);
    nodes_.push_back(n);
  }
  for (auto& v : other.fields_) fields_.push_back(value(value, v));
  for (auto t : other.types_) {
    if (t.proto) t.proto = now.proto(t.proto);
    std::vector<FieldDef> fields(t.fields.begin(), t.fields.end());
    for (auto& f : fields) f.default_value = value(value, f.default_value);
    add_type(t, fields);
  }
  for (auto p : other.protos_) {
    p.type = now.type(p.type);
    p.body = now.scope(p.body);
    p.where.begin = place(p.where.begin);
    protos_.push_back(std::move(p));
  }
  return now.scope(other.main);
}

}  // namespace wrlkit

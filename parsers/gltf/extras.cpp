#include "parsers/gltf/extras.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text/vrml_value.h"
#include "scenegraph/access_word.h"
#include "scenegraph/browser_nodes.h"
#include "scenegraph/equal.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::gltf_reader {
namespace {

Value empty_value(Scene& scene, FieldType t) {
  static constexpr double zeros[16] = {};
  static constexpr std::int32_t no_pixels[3] = {};
  const auto& i = info(t);
  switch (i.element) {
    case Element::text:
      return i.multiple ? scene.make(t, 0, std::span<const std::string_view>{}) : scene.make(t, 0, std::string_view{});
    case Element::node:
      return scene.make(t, 0, NodeId{});
    case Element::image:
      return scene.make(t, 0, std::span<const std::int32_t>(no_pixels));
    case Element::integer:
      return i.multiple ? scene.make(t, 0, std::span<const std::int32_t>{}) : scene.make(t, 0, std::int32_t{0});
    case Element::number:
      break;
  }
  return scene.make(t, 0, std::span<const double>(zeros, i.multiple ? 0 : i.arity));
}

std::int32_t to_int(double v) { return static_cast<std::int32_t>(std::clamp(v, -2147483648.0, 2147483647.0)); }

/// Words between blanks: "field SFInt32 n" is a field, too.
std::vector<std::string_view> words_of(std::string_view s) {
  std::vector<std::string_view> out;
  for (std::size_t at = 0; at <= s.size();) {
    auto end = std::min(s.find(' ', at), s.size());
    out.push_back(s.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

bool is_field_name(std::string_view name) {
  const auto words = words_of(name);
  if (words.size() == 1) return is_read_as_name(name);
  FieldType type{};
  return words.size() == 3 && find_access(words[0]) && find_field_type(words[1], type) && is_read_as_name(words[2]);
}

/// Words of VRML 1.0 are written without quotes: what is none of them would become something else.
bool is_written_safely(FieldType type, std::string_view text) {
  if (type == FieldType::SFBitMask) return text.empty() || is_vrml_value("(" + std::string(text) + ")");
  return type != FieldType::SFEnum || (!text.empty() && is_read_as_name(text) && text.find('(') == text.npos);
}

/// The type that a value of an unknown field is written with: {"SFInt32": 3}.
std::optional<FieldType> type_said(Json j) {
  FieldType type{};
  if (!j.is_object() || j.begin() == j.end() || !find_field_type((*j.begin()).key(), type)) return {};
  return type == FieldType::verbatim || info(type).element == Element::node ? std::nullopt : std::optional(type);
}

/// Fields are written by their names in VRML97. Those that a world of VRML97 has and its types do not are written as
/// text or as nodes; all others are fields that only X3D has.
std::optional<std::uint16_t> slot_named(const NodeType& type, Json field) {
  if (const auto slot = type.find(field.key(), Dialect::vrml97)) return slot;
  const auto slot = type.find(field.key(), Dialect::x3d);
  const bool nodes = slot && info(type.fields[*slot].type).element == Element::node;
  constexpr std::string_view of_x3d[] = {"metadata", "lineProperties", "fillProperties", "pointProperties",
                                         "textureProperties"};
  const bool may_be_unknown =
      field["verbatim"] || (nodes && std::ranges::find(of_x3d, field.key()) == std::end(of_x3d));
  return may_be_unknown ? std::nullopt : slot;
}

}  // namespace

void Extras::bad(Json j, std::string_view what) { c_.diag().report(Diag::gltf_bad_extras, c_.file.where(j), what); }

// ---- types ---------------------------------------------------------------------------------------------------------

TypeId Extras::type(std::string_view name, Json at) {
  for (std::size_t s = scope_;; s = scopes_[s].parent) {
    if (auto i = scopes_[s].types.find(name); i != scopes_[s].types.end()) return i->second;
    if (s == 0) break;
  }
  for (Dialect dialect : {Dialect::vrml97, Dialect::x3d})
    if (TypeId t = find_builtin(name, dialect)) return t;
  if (auto i = unknown_.find(name); i != unknown_.end()) return i->second;
  if (!is_read_as_name(name)) {
    bad(at, "a node type");
    return nodes::Group;
  }
  if (!find_browser_node(name)) c_.diag().report(Diag::unknown_node, c_.file.where(at), name);
  NodeType t;
  t.name = c_.scene.keep(name);
  t.kind = NodeKind::unknown;
  t.dialects = static_cast<DialectSet>(Dialect::vrml97);
  return unknown_[t.name] = c_.scene.add_type(t, {});
}

std::vector<FieldDef> Extras::interface(Json list, std::size_t first_slot) {
  std::vector<FieldDef> out;
  Children none_;
  for (Json row : list.elements()) {
    auto parts = row.elements();
    FieldDef f{};
    auto access = parts.size() >= 3 ? find_access(parts[0].text()) : std::nullopt;
    if (!access || !is_read_as_name(parts[2].text()) || !find_field_type(parts[1].text(), f.type) ||
        f.type == FieldType::verbatim || out.size() >= 60'000) {
      bad(row, "a field of an interface");
      continue;
    }
    f.access = *access;
    f.name = c_.scene.keep(parts[2].text());
    f.dialects = 0xff;
    const auto slot = static_cast<std::uint16_t>(first_slot + out.size());
    f.default_value = empty_value(c_.scene, f.type);
    if (parts.size() > 3 && (f.has_value() || parts[3]["IS"]))
      if (auto v = value(f.type, slot, parts[3], none_)) f.default_value = *v;
    f.default_value.slot = slot;
    out.push_back(f);
  }
  return out;
}

/// All types first: a body may hold instances of prototypes that stand behind it in the list.
void Extras::protos(Json list) {
  const auto all = list.elements();
  std::vector<ProtoId> ids;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Json p = all[i];
    const bool external = bool(p["EXTERNPROTO"]);
    if (!is_read_as_name(p[external ? "EXTERNPROTO" : "PROTO"].text())) return bad(p, "a prototype");
    auto in = p["in"].whole();
    const std::size_t parent = in && *in < i ? *in + 1 : 0;
    scope_ = parent;
    NodeType t;
    t.name = c_.scene.keep(p[external ? "EXTERNPROTO" : "PROTO"].text());
    t.kind = NodeKind::proto;
    t.dialects = 0xff;
    Proto proto;
    proto.type = c_.scene.add_type(t, interface(p["interface"]));
    proto.external = external;
    proto.where = c_.file.where(p);
    for (Json url : p["url"].elements()) proto.urls.push_back(c_.scene.keep(url.text()));
    scopes_.push_back({{}, parent});
    scopes_[parent].types[t.name] = proto.type;
    const TypeId type = proto.type;
    ids.push_back(c_.scene.add_proto(std::move(proto)));
    c_.scene.set_type_proto(type, ids.back());
    if (parent == 0) c_.scene.main.protos.push_back(ids.back());
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    scope_ = i + 1;
    Scope s = body(all[i]);
    for (std::size_t k = i + 1; k < all.size(); ++k)
      if (scopes_[k + 1].parent == i + 1) s.protos.push_back(ids[k]);
    c_.scene.proto(ids[i]).body = std::move(s);
  }
  scope_ = 0;
}

Scope Extras::body(Json proto) {
  Names outer;
  std::swap(outer, names_);
  const auto first = pending_.size();
  Scope s;
  Children none_;
  for (Json n : proto["body"].elements())
    if (NodeId id = reference(n, none_)) s.roots.push_back(id);
  resolve(first);
  links(proto, s);
  std::swap(outer, names_);
  return s;
}

// ---- values --------------------------------------------------------------------------------------------------------

std::optional<Value> Extras::numbers(FieldType t, std::uint16_t slot, Json j) {
  const auto& i = info(t);
  const bool real = i.element == Element::number;
  if (j.is_boolean()) return c_.scene.make(t, slot, std::int32_t{j.boolean()});
  if (j.is_number()) return real ? c_.scene.make(t, slot, j.number()) : c_.scene.make(t, slot, to_int(j.number()));
  std::vector<double> v;
  for (Json e : j.elements()) v.push_back(e.is_boolean() ? e.boolean() : e.number());
  const bool image = i.element == Element::image;
  if (!j.is_array() || (!image && !i.multiple && (i.arity == 1 || v.size() != i.arity)) ||
      (!image && v.size() % i.arity) || (image && v.size() < 3))
    return std::nullopt;
  if (real) return c_.scene.make(t, slot, v);
  std::vector<std::int32_t> whole(v.size());
  std::ranges::transform(v, whole.begin(), to_int);
  return c_.scene.make(t, slot, whole);
}

std::optional<Value> Extras::value(FieldType t, std::uint16_t slot, Json j, Children& children) {
  if (j["IS"].is_text()) {
    if (!is_read_as_name(j["IS"].text())) return std::nullopt;
    Value v = c_.scene.make(FieldType::verbatim, slot, j["IS"].text());
    v.type = t;
    v.is = true;
    return v;
  }
  switch (info(t).element) {
    case Element::node:
      return nodes(t, slot, j, children);
    case Element::text: {
      if (!info(t).multiple)
        return j.is_text() && is_written_safely(t, j.text()) ? std::optional(c_.scene.make(t, slot, j.text()))
                                                             : std::nullopt;
      if (!j.is_array()) return std::nullopt;
      std::vector<std::string_view> all;
      for (Json e : j) all.push_back(e.text());
      return c_.scene.make(t, slot, all);
    }
    case Element::integer:
    case Element::image:
    case Element::number:
      break;
  }
  // A scalar of several values and lists of one value cannot be mixed up: those are arrays.
  return j.is_array() == (info(t).multiple || info(t).arity > 1 || info(t).element == Element::image)
             ? numbers(t, slot, j)
             : std::nullopt;
}

Value Extras::nodes(FieldType t, std::uint16_t slot, Json j, Children& children) {
  std::vector<NodeId> all;
  auto one = [&](Json e) {
    NodeId n = reference(e, children);
    auto name = !n && e.is_object() && e.begin() != e.end() ? (*e.begin())["USE"].text() : std::string_view{};
    if (!name.empty() && owner_)
      pending_.push_back({owner_, slot, all.size(), c_.scene.keep(name)});
    else if (!name.empty())
      return c_.diag().report(Diag::undefined_use, c_.file.where(e), name);
    else if (!n)
      return;
    all.push_back(n);
  };
  if (j.is_array())
    for (Json e : j) one(e);
  else
    one(j);
  if (info(t).multiple) return c_.scene.make(t, slot, all);
  return c_.scene.make(t, slot, all.empty() ? NodeId{} : all[0]);
}

NodeId Extras::reference(Json j, Children& children) {
  auto take = [&] {
    NodeId n = children.front();
    children.pop_front();
    return n;
  };
  if (!j.is_object()) return children.empty() ? NodeId{} : take();
  if (j.begin() == j.end()) return {};
  const Json inner = *j.begin();
  if (auto name = inner["USE"].text(); !name.empty()) {
    if (!children.empty() && c_.scene.name(children.front()) == c_.names.of(name)) return take();
    return named(name);
  }
  NodeId n = c_.add(type(inner.key(), inner), inner);
  fields(n, inner);
  if (auto name = inner["DEF"]; name) c_.set_name(n, name);
  define(n);
  return n;
}

/// The value of a field that no table knows: text, or nodes.
std::optional<Value> Extras::unknown(Json j, Children& children) {
  if (j["IS"].is_text()) return value(FieldType::verbatim, 0, j, children);
  if (const auto text = j["verbatim"]; text.is_text()) {
    const bool is_safe = text.text().empty() || is_vrml_value(text.text());
    return is_safe ? std::optional(c_.scene.make(FieldType::verbatim, 0, text.text())) : std::nullopt;
  }
  if (const auto type = type_said(j)) return value(*type, 0, *j.begin(), children);
  const auto elements = j.elements();
  const auto all = [&](auto test) { return !elements.empty() && std::ranges::all_of(elements, test); };
  if (all([](Json e) { return e.is_text(); })) return value(FieldType::MFString, 0, j, children);
  if (all([](Json e) { return e.is_number(); })) return value(FieldType::MFFloat, 0, j, children);
  if (j.is_array()) return nodes(FieldType::MFNode, 0, j, children);
  if (j.is_object()) return nodes(FieldType::SFNode, 0, j, children);
  if (j.is_text()) return value(FieldType::SFString, 0, j, children);
  if (j.is_boolean()) return value(FieldType::SFBool, 0, j, children);
  if (j.is_number()) return value(FieldType::SFFloat, 0, j, children);
  const bool is_child = j && !j.is_number() && !j.is_boolean();  // null
  return is_child && !children.empty() ? std::optional(nodes(FieldType::SFNode, 0, j, children)) : std::nullopt;
}

// ---- nodes ---------------------------------------------------------------------------------------------------------

void Extras::fields(NodeId n, Json all, Children& children) {
  const NodeId outer = std::exchange(owner_, n);
  for (Json f : all.is_object() ? all : Json()) {
    if (f.key() == "DEF" || f.key() == "USE") continue;
    const bool is_proto = c_.scene.type(n).kind == NodeKind::proto;
    if (f.key() == "interface" && f.is_array()) {
      is_proto ? proto_values(n, f) : declare_fields(n, f);
      continue;
    }
    field(n, f, children);
  }
  owner_ = outer;
}

void Extras::field(NodeId n, Json f, Children& children) {
  auto slot = slot_named(c_.scene.type(n), f);
  if (!slot && !is_field_name(f.key())) return bad(f, "a field");
  if (!slot) owner_ = {};  // what has no slot cannot be filled in later
  auto v = slot ? value(c_.scene.type(n).fields[*slot].type, *slot, f, children) : unknown(f, children);
  owner_ = n;
  if (!v)
    bad(f, std::string(c_.scene.type(n).name) + "." + std::string(f.key()));
  else
    c_.scene.set(n, slot ? *v : c_.scene.make_extra(f.key(), *v));
}

void Extras::tags(NodeId n, Json all) {
  const NodeId outer = std::exchange(owner_, n);
  Children none_;
  for (Json f : all.is_object() ? all : Json()) {
    if (f.key() == "DEF" || f.key() == "USE" || f.key() == "interface") continue;
    const bool known = c_.scene.type(n).find(f.key(), Dialect::x3d) || c_.scene.type(n).find(f.key(), Dialect::vrml97);
    const bool says_more = f.key() == "metadata" || f.key() == "textureProperties";  // than a sampler
    if (says_more || !known) field(n, f, none_);
  }
  owner_ = outer;
}

void Extras::plain_fields(NodeId n, Json all) {
  Children none_;
  for (Json f : all.is_object() ? all : Json()) {
    auto slot = slot_named(c_.scene.type(n), f);
    if (!slot || info(c_.scene.type(n).fields[*slot].type).element == Element::node) continue;
    if (auto v = value(c_.scene.type(n).fields[*slot].type, *slot, f, none_)) c_.scene.set(n, *v);
  }
}

/// Fields that a Script declares: it gets a type of its own.
void Extras::declare_fields(NodeId n, Json list) {
  NodeType t = c_.scene.type(n);
  if (t.name != "Script") return bad(list, "an interface");
  std::vector<FieldDef> all(t.fields.begin(), t.fields.end());
  auto values = c_.scene.copy_of_fields(n);
  for (auto& f : interface(list, all.size())) {
    if (f.has_value() || f.default_value.is) values.push_back(f.default_value);
    f.default_value = empty_value(c_.scene, f.type);
    f.default_value.slot = static_cast<std::uint16_t>(all.size());
    all.push_back(f);
  }
  t.kind = NodeKind::script;
  c_.scene.become(n, c_.scene.add_type(t, all), values);
}

void Extras::proto_values(NodeId n, Json list) {
  Children none_;
  // Up to wrlkit 0.2 the list was always whole, with defaults for what was not given.
  const bool is_whole = list.elements().size() == c_.scene.type(n).fields.size();
  for (Json row : list.elements()) {
    auto parts = row.elements();
    if (parts.size() < 4) continue;
    const auto& t = c_.scene.type(n);
    auto slot = t.find(parts[2].text(), Dialect::vrml97);
    if (!slot) {
      bad(row, parts[2].text());
      continue;
    }
    auto v = value(t.fields[*slot].type, *slot, parts[3], none_);
    if (v && !(is_whole && equals_default(*v, t.fields[*slot]))) c_.scene.set(n, *v);
  }
}

void Extras::define(NodeId n) {
  if (auto name = c_.scene.name(n); !name.empty()) names_[std::string(name)] = n;
}

NodeId Extras::named(std::string_view name) const {
  auto i = names_.find(c_.names.of(name));  // as set_name has made it
  return i == names_.end() ? NodeId{} : i->second;
}

}  // namespace wrlkit::gltf_reader

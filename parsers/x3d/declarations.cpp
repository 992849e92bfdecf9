// What a document declares: the interfaces of prototypes and Scripts, IS, ROUTEs, IMPORTs and EXPORTs.
#include "parsers/vrml/grammar.h"
#include "parsers/x3d/grammar.h"
#include "scenegraph/access_word.h"

namespace wrlkit::x3d {

void Parser::is_element(const XmlNode& is, Element& e) {
  for_each_element(is, [&](const XmlNode& c) { c.name == "connect" ? connect(c, e) : unknown(c); });
}

void Parser::connect(const XmlNode& c, Element& e) {
  auto field = scene_.keep(get(c, "nodeField")), of_proto = scene_.keep(get(c, "protoField"));
  if (interfaces_.empty()) return diag_.report(Diag::is_outside, where(c));
  if (!interfaces_.back()->contains(of_proto)) diag_.report(Diag::unknown_is, where(c, "protoField"), of_proto);
  Value v = scene_.make(FieldType::verbatim, Value::extra_slot, of_proto);
  v.is = true;
  const auto& type = build_.current_type();
  auto own = e.own.find(field);
  auto slot = type.find(field, Dialect::x3d);
  if (own != e.own.end() || slot) {
    const auto& f = own != e.own.end() ? own->second : type.fields[*slot];
    v.type = f.type;
    v.slot = own != e.own.end() ? f.default_value.slot : *slot;
    return build_.field(v, where(c));
  }
  if (!type.takes_any_field() && !type.find(field, Dialect::x3d, true))
    diag_.report(Diag::unknown_field, where(c, "nodeField"), type.name, field);
  build_.field(scene_.make_extra(field, v), where(c));
}

bool Parser::element_value(const XmlNode& n, FieldType type, std::uint16_t slot, std::string_view name,
                           const Value& fallback, Value& out) {
  if (info(type).element != wrlkit::Element::node) {
    auto text = raw(n, "value");
    // Xj3D's own files have the value between the tags.
    for_each_child(n, [&](const XmlNode& c) {
      if (!text && c.kind == XmlNode::Kind::text) text = c.content;
    });
    return text && value(type, slot, name, fallback, *text, out);
  }
  std::vector<NodeId> list;
  for_each_element(n, [&](const XmlNode& c) {
    if (NodeId id = node(c)) list.push_back(id);
  });
  if (type == FieldType::SFNode)
    out = scene_.make(type, slot, list.empty() ? NodeId{} : list[0]);
  else
    out = scene_.make(type, slot, list);
  return !list.empty();
}

std::optional<FieldDef> Parser::declaration(const XmlNode& n, bool with_value) {
  FieldDef f{};
  f.name = scene_.keep(get(n, "name"));
  f.dialects = 0xff;
  auto type = get(n, "type");
  if (f.name.empty() || !find_field_type(type, f.type)) {
    diag_.report(Diag::bad_value, where(n, "type"), "'" + std::string(type) + "'", "field type");
    return std::nullopt;
  }
  auto access = find_access(get(n, "accessType"));
  if (!access)
    diag_.report(Diag::bad_value, where(n, "accessType"), "'" + std::string(get(n, "accessType")) + "'", "access type");
  f.access = access.value_or(Access::inout);
  f.default_value = empty_value(f.type);
  if (Value v; with_value && f.has_value() && element_value(n, f.type, Value::extra_slot, f.name, f.default_value, v))
    f.default_value = v;
  return f;
}

void Parser::script_field(const XmlNode& n, Element& e) {
  if (build_.current_type().name != "Script") {
    if (!build_.current_type().takes_any_field())
      diag_.report(Diag::unknown_field, where(n), build_.current_type().name, "field " + std::string(get(n, "name")));
    for_each_element(n, [&](const XmlNode& c) {
      if (NodeId id = node(c)) e.extra[scene_.keep(get(n, "name"))].push_back(id);
    });
    return;
  }
  auto f = declaration(n, false);
  if (!f) return;
  auto slot = build_.declare(*f, where(n));
  if (!slot) return;
  f->default_value.slot = *slot;
  e.own[f->name] = *f;
  for_each_element(n, [&](const XmlNode& c) {
    if (c.name == "IS") is_element(c, e);
  });
  Value v;
  if (f->has_value() && element_value(n, f->type, *slot, f->name, f->default_value, v))
    build_.field(v, where(n, "value"));
}

void Parser::field_value(const XmlNode& n) {
  const auto& type = build_.current_type();
  auto name = get(n, "name");
  auto slot = type.find(name, Dialect::x3d);
  Value v;
  if (slot && type.fields[*slot].has_value()) {
    const auto& f = type.fields[*slot];
    if (element_value(n, f.type, *slot, f.name, f.default_value, v)) build_.field(v, where(n, "value"));
    return;
  }
  if (!type.takes_any_field()) diag_.report(Diag::unknown_field, where(n, "name"), type.name, name);
  std::vector<NodeId> list;
  for_each_element(n, [&](const XmlNode& c) {
    if (NodeId id = node(c)) list.push_back(id);
  });
  v = list.empty() ? scene_.make(FieldType::verbatim, Value::extra_slot, as_vrml(get(n, "value")))
                   : scene_.make(FieldType::MFNode, Value::extra_slot, list);
  build_.field(scene_.make_extra(scene_.keep(name), v), where(n));
}

std::vector<FieldDef> Parser::interface(const XmlNode& n, Names& names) {
  std::vector<FieldDef> out;
  const bool external = n.name == "ExternProtoDeclare";
  for_each_element(n, [&](const XmlNode& c) {
    if (c.name != "field") return unknown(c);
    auto f = declaration(c, !external);
    if (!f) return;
    if (out.size() >= SceneBuilder::most_fields)
      return diag_.report(Diag::expansion_limit, where(c), SceneBuilder::most_fields, "fields");
    if (!names.insert(f->name).second)
      return diag_.report(Diag::duplicate_field, where(c, "name"), f->name, "the first one counts");
    f->default_value.slot = static_cast<std::uint16_t>(out.size());
    out.push_back(*f);
  });
  return out;
}

void Parser::proto(const XmlNode& n) {
  auto name = scene_.keep(get(n, "name"));
  if (depth_ >= limits_.depth) return diag_.report(Diag::too_deep, where(n), limits_.depth);
  Names names;
  std::vector<FieldDef> fields;
  const XmlNode *interface_element = find_element(n, "ProtoInterface"), *body = find_element(n, "ProtoBody");
  if (interface_element) fields = interface(*interface_element, names);
  Proto p;
  p.where = where(n);
  build_.open_scope();
  interfaces_.push_back(&names);
  ++depth_;
  if (body) roots(*body);
  --depth_;
  interfaces_.pop_back();
  p.body = build_.close_scope();
  if (p.body.roots.empty()) diag_.report(Diag::empty_proto, where(n, "name"), name);
  p.type = build_.proto_type(name, fields);
  build_.declare_proto(std::move(p), where(n, "name"));
}

void Parser::externproto(const XmlNode& n) {
  Names names;
  Proto p;
  p.where = where(n);
  p.external = true;
  Value urls;
  if (auto url = raw(n, "url"); url && value(FieldType::MFString, 0, "url", {}, *url, urls))
    p.urls.assign(urls.text_span().begin(), urls.text_span().end());
  p.type = build_.proto_type(get(n, "name"), interface(n, names));
  build_.declare_proto(std::move(p), where(n, "name"));
}

void Parser::route(const XmlNode& n) {
  build_.route(name_of(raw(n, "fromNode").value_or("")), get(n, "fromField"), name_of(raw(n, "toNode").value_or("")),
               get(n, "toField"), where(n));
}

// Without AS the name stays.
void Parser::import(const XmlNode& n) {
  const auto exported = raw(n, "importedDEF").value_or("");
  build_.import_name(name_of(raw(n, "inlineDEF").value_or("")), name_of(exported),
                     name_of(raw(n, "AS").value_or(exported)), where(n));
}

void Parser::export_(const XmlNode& n) {
  const auto local = raw(n, "localDEF").value_or("");
  build_.export_name(name_of(local), name_of(raw(n, "AS").value_or(local)), where(n));
}

}  // namespace wrlkit::x3d

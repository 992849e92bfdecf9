#include "parsers/x3d/parser.h"

#include <algorithm>

#include "base/text/backslash.h"
#include "base/text/blanks.h"
#include "base/text/letter_case.h"
#include "base/text/vrml_value.h"
#include "parsers/x3d/grammar.h"
#include "parsers/x3d/page.h"
#include "scenegraph/container_field.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/nodes.h"

namespace wrlkit::x3d {

// ---- the document --------------------------------------------------------------------------------------------------

void Parser::document() {
  for (auto& n : tree_.nodes) n.name.remove_prefix(n.name.find(':') + 1);  // of a namespace
  if (auto declared = whole_.substr(0, whole_.find("?>")); declared.starts_with("<?xml"))
    for (auto name : {"ISO-8859-1", "iso-8859-1", "Latin-1", "latin1", "windows-1252", "Windows-1252"})
      latin1_ |= declared.find(name) != declared.npos;
  const XmlNode& top = tree_.nodes[0];
  for (auto i = top.first_child; i != XmlNode::none && tree_.nodes[i].kind != XmlNode::Kind::element;
       i = tree_.nodes[i].next)
    if (tree_.nodes[i].kind == XmlNode::Kind::comment) comment(tree_.nodes[i]);
  auto is = [](const XmlNode& n, std::string_view name) {
    return n.kind == XmlNode::Kind::element && equal_ignoring_case(n.name, name);
  };
  const XmlNode* x3d = find_element(top, "X3D");
  // A page has it somewhere within, in small letters.
  for (const auto& n : tree_.nodes)
    if (!x3d && is(n, "x3d")) x3d = &n;
  if (!x3d) {
    diag_.report(Diag::x3d_repaired, Span{}, "there is no X3D element; the document is taken as one");
    x3d = &top;
  }
  scene_.x3d.version = version_number(get(*x3d, "version"));
  scene_.x3d.profile = get(*x3d, "profile");
  if (const XmlNode* h = find_element(*x3d, "head")) head(*h);
  const XmlNode* scene = find_element(*x3d, "Scene");
  if (scene) roots(*scene);
  for_each_element(*x3d, [&](const XmlNode& n) {
    if (&n == scene || n.name == "head") return;
    if (is(n, "scene")) return roots(n);
    const bool fragment = x3d == &top && build_.known_type(n.name);
    if (scene || (x3d == &top && !fragment)) return unknown(n);
    if (!fragment) diag_.report(Diag::x3d_repaired, where(n), "the Scene element is missing");
    if (!statement(n))
      if (NodeId id = node(n)) build_.root(id);
  });
  for (const auto& f : tree_.repaired)
    diag_.report(f.lost ? Diag::xml_syntax : Diag::x3d_repaired,
                 span_of(whole_.substr(std::min(f.at, whole_.size()), 1)),
                 f.lost ? f.what + "; it is passed over" : std::string("a blank is missing between two attributes"));
  if (!tree_.fault.empty())
    diag_.report(Diag::xml_syntax, span_of(whole_.substr(std::min(tree_.fault_at, whole_.size()), 1)),
                 tree_.fault + "; what stands behind is not read");
  scene_.main = build_.close_scope();
  apply(units_, scene_, diag_);
}

void Parser::comment(const XmlNode& n) {
  std::string_view rest = n.content;
  rest.remove_prefix(rest.starts_with("\r\n") ? 2 : rest.starts_with('\n'));
  while (!rest.empty()) {
    auto line = rest.substr(0, rest.find('\n'));
    const bool whole = line.size() < rest.size();
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    while (!line.empty() && line.back() <= ' ') line.remove_suffix(1);
    if (!line.empty() || whole) ((scene_.comment += '#') += verbatim_text(line)) += '\n';
  }
}

void Parser::head(const XmlNode& h) {
  for_each_element(h, [&](const XmlNode& n) {
    if (n.name == "meta")
      scene_.x3d.meta.emplace_back(get(n, "name"), get(n, "content"));
    else if (n.name == "component")
      component(n);
    else if (n.name == "unit")
      unit(n);
    else
      unknown(n);
  });
}

void Parser::component(const XmlNode& n) {
  scene_.x3d.components.emplace_back(get(n, "name"), std::atoi(std::string(get(n, "level")).c_str()));
}

void Parser::unit(const XmlNode& n) {
  auto factor = get(n, "conversionFactor");
  if (!units_.set(get(n, "category"), std::strtod(std::string(factor).c_str(), nullptr)))
    diag_.report(Diag::unit_dropped, where(n, "conversionFactor"), get(n, "category"), factor);
}

void Parser::roots(const XmlNode& scene) {
  for_each_element(scene, [&](const XmlNode& n) {
    if (statement(n)) return;
    if (NodeId id = node(n)) build_.root(id);
  });
}

bool Parser::statement(const XmlNode& n) {
  if (n.name == "ROUTE") {
    route(n);
    return true;
  }
  if (n.name == "ProtoDeclare") {
    proto(n);
    return true;
  }
  if (n.name == "ExternProtoDeclare") {
    externproto(n);
    return true;
  }
  if (n.name == "IMPORT") {
    import(n);
    return true;
  }
  if (n.name == "EXPORT") {
    export_(n);
    return true;
  }
  return false;
}

// ---- nodes ---------------------------------------------------------------------------------------------------------

TypeId Parser::type_of(const XmlNode& n) {
  if (n.name == "ProtoInstance") return build_.type(scene_.keep(get(n, "name")), where(n, "name"));
  return build_.type(verbatim_text(n.name), where(n));
}

NodeId Parser::node(const XmlNode& n) {
  if (auto use = raw(n, "USE")) return build_.use(name_of(*use), span_of(*use));
  if (depth_ >= limits_.depth || scene_.node_count() >= limits_.nodes) {
    diag_.report(Diag::too_deep, where(n), limits_.depth);
    return NodeId{};
  }
  ++depth_;
  NodeId id = build_.open(type_of(n), name_of(raw(n, "DEF").value_or("")), where(n));
  Element e{n.name, {}, {}, {}, {}};
  if (n.name != "ProtoInstance") attributes(n, e);
  for_each_child(n, [&](const XmlNode& c) { child(c, e); });
  program(e);
  extras(e);
  build_.close();
  --depth_;
  return id;
}

void Parser::attributes(const XmlNode& n, Element& e) {
  for (const auto& a : tree_.attributes_of(n)) {
    const auto name = a.name;
    const bool of_xml = name == "DEF" || name == "containerField" || name == "class" || name == "id" ||
                        name == "style" || name == "nodeType" || name.find(':') != name.npos;
    if (!of_xml || (name != "containerField" && name != "DEF" && build_.current_type().find(name, Dialect::x3d)))
      attribute(a, e);
  }
}

void Parser::attribute(const XmlAttribute& a, Element&) {
  const auto& type = build_.current_type();
  Value v;
  if (auto slot = type.find(a.name, Dialect::x3d); slot && type.fields[*slot].has_value()) {
    const auto& f = type.fields[*slot];
    if (value(f.type, *slot, f.name, f.default_value, a.value, v)) build_.field(v, span_of(a.value));
    return;
  }
  if (!type.takes_any_field()) diag_.report(Diag::unknown_field, span_of(a.name), type.name, a.name);
  v = scene_.make(FieldType::verbatim, Value::extra_slot, as_vrml(plain(a.value)));
  build_.field(scene_.make_extra(scene_.keep(verbatim_text(a.name)), v), span_of(a.value));
}

void Parser::child(const XmlNode& c, Element& e) {
  const bool script = build_.current_type().name == "Script";
  if (c.kind == XmlNode::Kind::text) {
    auto text = c.cdata ? verbatim_text(c.content) : plain(c.content, false);
    if (script && (!e.program.empty() || !trim(text).empty())) {
      if (e.program.empty()) {
        e.program_at = span_of(c.content);
        text.remove_prefix(text.find_first_not_of(" \t\r\n"));
      }
      e.program += text;
    } else if (!trim(text).empty())
      diag_.report(Diag::stray_token, span_of(c.content), "'" + std::string(trim(text).substr(0, 60)) + "'");
  }
  if (c.kind != XmlNode::Kind::element) return;
  if (statement(c)) return;
  if (c.name == "IS") return is_element(c, e);
  if (c.name == "connect") return connect(c, e);
  if (c.name == "field") return script_field(c, e);
  if (c.name == "fieldValue") return field_value(c);
  child_node(c, e);
}

// The program of a Script in the text of the file, which may be in several pieces, as an url of its own.
void Parser::program(const Element& e) {
  if (e.program.empty()) return;
  build_.field(scene_.make(FieldType::MFString, nodes::script::url.slot, std::vector<std::string_view>{e.program}),
               e.program_at);
}

void Parser::child_node(const XmlNode& c, Element& e) {
  NodeId id = node(c);
  if (id) put(c, id, e);
}

void Parser::put(const XmlNode& c, NodeId id, Element& e) {
  const auto& type = build_.current_type();
  auto said = raw(c, "containerField");
  auto name = said ? plain(*said) : container_field(scene_, id);
  // Since version 4.0 what is in a MetadataSet is one of its values.
  if (!said && scene_.x3d.version >= 40 && type.name == "MetadataSet") name = "value";
  auto slot = type.find(name, Dialect::x3d);
  if (slot && put_into_slot(*slot, id, where(c))) return;
  if (type.kind == NodeKind::unknown) return e.extra[scene_.keep(name)].push_back(id);
  if (auto other = slot_by_kind(id)) {
    if (said)
      diag_.report(Diag::container_repaired, span_of(*said), type.name, name, scene_.type(id).name,
                   type.fields[*other].name);
    put_into_slot(*other, id, where(c));
    return;
  }
  if (auto children = type.find("children", Dialect::x3d); children && scene_.is(id, nodes::X3DGeometryNode)) {
    diag_.report(Diag::shape_repaired, where(c), scene_.type(id).name);
    NodeId shape = scene_.add(nodes::Shape, where(c));
    scene_.set(shape, nodes::shape::geometry, id);
    put_into_slot(*children, shape, where(c));
    return;
  }
  diag_.report(Diag::unknown_field, where(c, "containerField"), type.name, name);
  e.extra[scene_.keep(name)].push_back(id);
}

bool Parser::put_into_slot(std::uint16_t slot, NodeId id, Span at) {
  const auto type = build_.current_type().fields[slot].type;
  if (type == FieldType::MFNode) {
    build_.append_child(slot, id);
    return true;
  }
  if (type != FieldType::SFNode) return false;
  build_.field(scene_.make(type, slot, id), at);
  return true;
}

/// The first field that may hold such a node.
std::optional<std::uint16_t> Parser::slot_by_kind(NodeId n) const {
  const auto& fields = build_.current_type().fields;
  const auto& t = scene_.type(n);
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (fields[i].has_value() && info(fields[i].type).element == wrlkit::Element::node && fields[i].accepts(t))
      return static_cast<std::uint16_t>(i);
  return std::nullopt;
}

void Parser::extras(Element& e) {
  for (auto& [name, list] : e.extra)
    build_.field(scene_.make_extra(name, scene_.make(FieldType::MFNode, Value::extra_slot, list)),
                 scene_.where(build_.current()));
}

// ---- the tree ------------------------------------------------------------------------------------------------------

const XmlNode* Parser::find_element(const XmlNode& n, std::string_view name) {
  const XmlNode* found = nullptr;
  for_each_element(n, [&](const XmlNode& c) {
    if (!found && c.name == name) found = &c;
  });
  return found;
}

std::string_view Parser::name_of(std::string_view attribute) {
  const auto name = plain(attribute);
  if (is_one_word(name)) return name;
  const auto [at, is_new] = repaired_.try_emplace(std::string(name));
  if (is_new) at->second = scene_.keep(free_name(name));
  const std::string legal(at->second);
  diag_.report(Diag::x3d_repaired, span_of(attribute), "name '" + std::string(name) + "' is read as '" + legal + "'");
  return at->second;
}

std::string Parser::free_name(std::string_view name) {
  if (taken_.empty())
    for (const auto& a : tree_.attributes)
      if (a.name == "DEF") taken_.emplace(plain(a.value));
  const auto legal = as_one_word(name);
  auto out = legal;
  for (int k = 2; !taken_.insert(out).second; ++k) out = legal + "_" + std::to_string(k);
  return out;
}

std::optional<std::string_view> Parser::raw(const XmlNode& n, std::string_view name) const {
  for (const auto& a : tree_.attributes_of(n))
    if (a.name == name) return a.value;
  return std::nullopt;
}

std::string as_vrml(std::string_view s) {
  s = trim(s);
  if (s == "true" || s == "TRUE") return "TRUE";
  if (s == "false" || s == "FALSE") return "FALSE";
  if (!is_vrml97_value(s)) return in_quotes(s);
  return is_bare_list_of_strings(s) ? "[" + std::string(s) + "]" : std::string(s);
}

int version_number(std::string_view s) {
  s = trim(s);
  const bool good = s.size() >= 3 && s[0] >= '3' && s[0] <= '4' && s[1] == '.' && s[2] >= '0' && s[2] <= '9';
  return good ? (s[0] - '0') * 10 + (s[2] - '0') : 33;
}

void parse(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag) {
  const auto page = world_of_page(text);
  if (page) {
    text = scene.keep(page->xml);
    base += static_cast<std::uint32_t>(page->begin);
  }
  Parser(text, base, limits, scene, diag).document();
}

}  // namespace wrlkit::x3d

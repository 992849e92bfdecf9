// The grammar of VRML 1.0: a node is its fields and, behind or between them, its children. It shares tokens and values
// with VRML97. What differs is here: strings without quotes, enumerations and bit masks, names such as `+0` (Inventor
// makes them), nodes that describe themselves, and two habits of Inventor: `radius 2 ~` and `radius 2 = Engine { } .
// output`.
//
// Files of Castle Game Engine have nodes of VRML97 among those of VRML 1.0 ("the sum of VRML 1.0 and 2.0"). Where both
// have a node of that name, the node in whose field it stands decides.
#include "parsers/vrml/vrml1.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/text/bit_mask.h"
#include "parsers/vrml/values.h"
#include "scenegraph/nodes.h"

namespace wrlkit::vrml {
namespace {

/// TRUE, CLOCKWISE: a value and not the name of a field.
bool is_constant(std::string_view word) {
  return std::ranges::none_of(word, [](char c) { return c >= 'a' && c <= 'z'; });
}

bool is_vrml97(const NodeType& t) { return !(t.dialects & static_cast<DialectSet>(Dialect::vrml1)); }

/// Field types under the names that Inventor and VRML 1.0 have for them.
bool find_type(std::string_view name, FieldType& out) {
  if (name == "SFLong" || name == "SFULong" || name == "SFShort" || name == "SFUShort" || name == "SFUInt32")
    name = "SFInt32";
  else if (name == "MFLong" || name == "MFULong" || name == "MFShort" || name == "MFUShort" || name == "MFUInt32")
    name = "MFInt32";
  else if (name == "SFName")
    name = "SFString";
  else if (name == "MFName" || name == "MFEnum" || name == "MFBitMask")
    name = "MFString";
  else if (name == "MFMatrix")
    name = "MFMatrix4f";
  else if (name == "SFPlane")
    name = "SFVec4f";
  return find_field_type(name, out);
}

class Vrml1Parser : private Values {
 public:
  Vrml1Parser(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag)
      : Values(text, base, scene, diag), limits_(limits), build_(scene, diag) {}

  void file() {
    for (Token t = lex_.peek(); t.kind != Kind::end; t = lex_.peek()) {
      if (!node_follows(t)) {
        stray();
        continue;
      }
      if (NodeId n = node_statement()) build_.root(n);
      for (NodeId n : std::exchange(misplaced_, {})) build_.root(n);
    }
    scene_.main = build_.close_scope();
  }

 private:
  /// State for the node whose body is read.
  struct Body {
    std::vector<std::pair<std::string_view, FieldType>> own;  // that it describes itself
    std::vector<NodeId> children;                             // of a node that is not known
  };

  // Nodes.
  bool node_follows(Token);
  NodeId node_statement();
  NodeId node(Token type_name, std::string_view def);
  TypeId type_of(Token name);
  void node_body(Token opened);
  void element(Token, Body&);
  void child(NodeId, Token where, Body&);
  void stray();

  // Fields.
  void own_fields(Body&);
  void known_field(FieldType, std::uint16_t slot, Token name, const Value& fallback);
  bool old_field(Token name);
  void unknown_field(Token name);
  bool value(FieldType, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out);
  bool node_value(FieldType, std::uint16_t slot, Value& out);
  void connection(Token name);
  /// A name, and none of the signs that stand between values.
  bool is_name(Token t) const {
    if (!name_like(t) || text(t)[0] == '.') return false;
    auto w = text(t).substr(0, text(t).find('('));
    return !w.empty() && w.find_first_of("|=~)") == w.npos;
  }
  bool take_word(std::string_view w) {
    const bool is_next = text(lex_.peek()) == w;
    if (is_next) lex_.next();
    return is_next;
  }

  ParseLimits limits_;
  SceneBuilder build_;
  bool in_vrml97_field_ = false;   // names mean nodes of VRML97 first
  std::vector<NodeId> misplaced_;  // nodes in nodes that can hold none; they are taken behind those
};

// ---- nodes ---------------------------------------------------------------------------------------------------------

bool Vrml1Parser::node_follows(Token t) {
  if (!is_name(t)) return false;
  auto w = text(t);
  if (w == "DEF" || w == "USE" || w == "NULL") return true;
  auto at = lex_.offset();
  lex_.seek(t.end);
  bool brace = lex_.peek().kind == Kind::open_brace;
  lex_.seek(at);
  return brace;
}

NodeId Vrml1Parser::node_statement() {
  Token t = lex_.next();
  if (text(t) == "NULL") return {};
  if (text(t) == "USE") {
    Token name = lex_.next_name();
    if (!is_word(name)) return NodeId{};
    return build_.use(name_of(name), span(name));
  }
  std::string_view def;
  if (text(t) == "DEF") {
    Token name = lex_.next_name();
    if (!is_word(name)) return NodeId{};
    if (is_name(name) && lex_.peek().kind == Kind::open_brace) {
      diag_.report(Diag::def_without_name, span(name));
      lex_.next();
      return node(name, {});
    }
    def = name_of(name);
    t = lex_.next();
  }
  if (!is_name(t)) {
    reject("a node", t);
    return NodeId{};
  }
  if (Token brace = lex_.peek(); brace.kind != Kind::open_brace) {
    expected("'{'", brace);
    return NodeId{};
  }
  lex_.next();
  return node(t, def);
}

TypeId Vrml1Parser::type_of(Token name) {
  auto w = name_of(name);
  TypeId own = find_builtin(w, Dialect::vrml1), foreign = find_builtin(w, Dialect::vrml97);
  const auto first = text(lex_.peek());
  const bool describes = first == "fields" || first == "isA", of_x3d = !own && !foreign && !describes;
  if (of_x3d) foreign = find_builtin(w, Dialect::x3d);
  if (foreign && (in_vrml97_field_ || !own)) {
    if (!in_vrml97_field_) diag_.report(Diag::dialect_node, span(name), w, of_x3d ? "X3D" : "VRML97", "VRML 1.0");
    return foreign;
  }
  if (own) return own;
  return describes ? build_.unknown_type(w) : build_.type(w, span(name));
}

NodeId Vrml1Parser::node(Token type_name, std::string_view def) {
  if (build_.depth() >= limits_.depth || scene_.node_count() >= limits_.nodes) {
    diag_.report(Diag::too_deep, span(type_name), limits_.depth);
    skip_to_close(Kind::open_brace, Kind::close_brace);
    return {};
  }
  NodeId n = build_.open(type_of(type_name), def, span(type_name));
  const bool around = std::exchange(in_vrml97_field_, false);
  node_body(type_name);
  in_vrml97_field_ = around;
  build_.close();
  return n;
}

void Vrml1Parser::node_body(Token opened) {
  Body body;
  for (;;) {
    Token t = lex_.peek();
    if (ends(t, Kind::close_brace, opened)) break;
    if (is_name(t))
      element(t, body);
    else
      stray();
  }
  if (!body.children.empty())
    build_.field(scene_.make_extra("children", scene_.make(FieldType::MFNode, Value::extra_slot, body.children)),
                 span(opened));
}

void Vrml1Parser::element(Token t, Body& body) {
  const auto& type = build_.current_type();
  if (auto paren = text(t).find('('); paren != 0 && paren != std::string_view::npos)
    t.end = t.begin + static_cast<std::uint32_t>(paren);  // parts(SIDES)
  auto w = text(t);
  if (auto own = std::ranges::find(body.own, w, [](auto& f) { return f.first; }); own != body.own.end()) {
    lex_.seek(t.end);
    known_field(own->second, Value::extra_slot, t, empty_value(own->second));
  } else if (auto slot = type.find(w, is_vrml97(type) ? Dialect::vrml97 : Dialect::vrml1);
             slot && type.fields[*slot].has_value()) {
    lex_.seek(t.end);
    known_field(type.fields[*slot].type, *slot, t, type.fields[*slot].default_value);
  } else if (node_follows(t)) {
    const bool around = std::exchange(in_vrml97_field_, is_vrml97(type) && type.find("children", Dialect::vrml97));
    if (NodeId n = node_statement()) child(n, t, body);
    in_vrml97_field_ = around;
    for (NodeId n : std::exchange(misplaced_, {})) child(n, t, body);
  } else if (w == "fields") {
    lex_.seek(t.end);
    own_fields(body);
  } else if (is_constant(w)) {
    stray();
  } else {
    lex_.seek(t.end);
    if (old_field(t)) return;
    if (w == "isA")
      known_field(FieldType::MFString, Value::extra_slot, t, empty_value(FieldType::MFString));
    else
      unknown_field(t);
  }
}

void Vrml1Parser::child(NodeId n, Token where, Body& body) {
  const auto& type = build_.current_type();
  if (auto slot = type.find("children", is_vrml97(type) ? Dialect::vrml97 : Dialect::vrml1))
    return build_.append_child(*slot, n);
  if (type.kind == NodeKind::unknown) return body.children.push_back(n);
  diag_.report(Diag::misplaced_node, span(where), describe(where));
  misplaced_.push_back(n);
}

void Vrml1Parser::stray() {
  Token first = lex_.next();
  diag_.report(Diag::stray_token, span(first), describe(first));
  for (Token t = first;; t = lex_.next()) {
    if (t.kind == Kind::open_brace) skip_to_close(Kind::open_brace, Kind::close_brace);
    if (t.kind == Kind::open_bracket) skip_to_close(Kind::open_bracket, Kind::close_bracket);
    Token next = lex_.peek();
    if (next.kind == Kind::end || next.kind == Kind::close_brace || (is_name(next) && !is_constant(text(next))) ||
        node_follows(next))
      return;
  }
}

// ---- fields --------------------------------------------------------------------------------------------------------

// fields [ SFFloat width, SFFloat height ]: what follows in the node is of these types. Of nodes of the standard they
// report what is known.
void Vrml1Parser::own_fields(Body& body) {
  Token open = lex_.next();
  if (open.kind != Kind::open_bracket) {
    return reject("'['", open);
  }
  for (Token t = lex_.next(); t.kind != Kind::close_bracket; t = lex_.next()) {
    FieldType type{};
    if (t.kind == Kind::end) return unclosed(open);
    if (t.kind == Kind::close_brace) {
      return reject("']'", t);
    }
    if (!find_type(text(t), type)) {
      expected("a field type", t);
      continue;
    }
    Token name = lex_.next();
    if (!name_like(name)) {
      reject("a name", name);
      continue;
    }
    if (!build_.current_type().find(text(name), Dialect::vrml1) && body.own.size() < SceneBuilder::most_fields)
      body.own.emplace_back(name_of(name), type);
  }
}

void Vrml1Parser::known_field(FieldType type, std::uint16_t slot, Token name, const Value& fallback) {
  Value v;
  bool good = false;
  if (auto next = text(lex_.peek()); next != "~" && next != "=") good = value(type, slot, text(name), fallback, v);
  if (take_word("~")) {
    diag_.report(Diag::ignored_field, span(name), text(name));
    good = false;
  }
  if (text(lex_.peek()) == "=") connection(name);
  if (!good) return;
  build_.field(slot == Value::extra_slot ? scene_.make_extra(name_of(name), v) : v, span(name));
}

void Vrml1Parser::connection(Token name) {
  lex_.next();
  diag_.report(Diag::no_engine, span(name), text(name));
  if (take_word("USE"))
    lex_.next();
  else
    node_statement();
  Token dot = lex_.peek();
  if (!text(dot).starts_with('.')) return;
  lex_.next();
  if (text(dot) == ".") lex_.next();
}

// Fields that Inventor 1.0 and 2.0 had: ShapeHints.hints as three fields of today, PackedColor.rgba, which is
// 0xaabbggrr, as orderedRGBA. False: it is none of them, and nothing was read.
bool Vrml1Parser::old_field(Token name) {
  namespace hints = nodes::vrml1::shape_hints;
  namespace packed = nodes::vrml1::packed_color;
  Value v;
  const auto& type = build_.current_type();
  if (type.name == "PackedColor" && text(name) == "rgba") {
    if (!value(FieldType::MFInt32, packed::orderedRGBA.slot, text(name), {}, v)) return true;
    std::vector<std::int32_t> out;
    for (const std::int32_t i : v.integer_span()) {
      const auto c = static_cast<std::uint32_t>(i);
      out.push_back(static_cast<std::int32_t>(c << 24 | (c << 8 & 0xff0000) | (c >> 8 & 0xff00) | c >> 24));
    }
    build_.field(scene_.make(FieldType::MFInt32, packed::orderedRGBA.slot, out), span(name));
    return true;
  }
  if (type.name != "ShapeHints" || text(name) != "hints") return false;
  if (!value(FieldType::SFBitMask, hints::shapeType.slot, text(name), {}, v)) return true;
  const auto set = [&](std::uint16_t slot, std::string_view bit, std::string_view yes, std::string_view no) {
    build_.field(scene_.make(FieldType::SFEnum, slot, has_bit(v.text(), bit) ? yes : no), span(name));
  };
  set(hints::vertexOrdering.slot, "ORDERED", "COUNTERCLOCKWISE", "UNKNOWN_ORDERING");
  set(hints::shapeType.slot, "SOLID", "SOLID", "UNKNOWN_SHAPE_TYPE");
  set(hints::faceType.slot, "CONVEX", "CONVEX", "UNKNOWN_FACE_TYPE");
  return true;
}

// As in VRML97: nodes in it are read, the rest is kept as text. A word that is not a node or a field can only be a
// value.
void Vrml1Parser::unknown_field(Token name) {
  const auto& type = build_.current_type();
  if (!type.takes_any_field()) diag_.report(Diag::unknown_field, span(name), type.name, text(name));
  Value v;
  Token t = lex_.peek();
  if (node_follows(t)) {
    if (!node_value(FieldType::SFNode, Value::extra_slot, v)) return;
  } else {
    auto s = verbatim();
    Token next = lex_.peek();
    if (s.empty() && next.kind == Kind::word && text(next)[0] == '(') {
      if (enumeration(FieldType::SFBitMask, Value::extra_slot, v)) s = '(' + std::string(v.text()) + ')';
    } else if (s.empty() && is_name(next) && is_constant(text(next)) && !node_follows(next)) {
      s = utf8(text(next), span(lex_.next()));
    }
    v = scene_.make(FieldType::verbatim, Value::extra_slot, s);
  }
  build_.field(scene_.make_extra(name_of(name), v), span(name));
}

bool Vrml1Parser::value(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out) {
  const bool read =
      info(type).element == Element::node ? node_value(type, slot, out) : vrml1_value(type, slot, field, fallback, out);
  if (!read) skip_values();
  return read;
}

bool Vrml1Parser::node_value(FieldType type, std::uint16_t slot, Value& out) {
  std::vector<NodeId> list;
  const bool around = std::exchange(in_vrml97_field_, is_vrml97(build_.current_type()));
  const bool bracket = take(Kind::open_bracket);
  for (Token t = lex_.peek(); node_follows(t); t = lex_.peek()) {
    if (NodeId n = node_statement()) list.push_back(n);
    if (!bracket) break;
  }
  in_vrml97_field_ = around;
  if (bracket && !take(Kind::close_bracket)) {
    expected("a node or ']'", lex_.peek());
    skip_list();
  }
  if (info(type).multiple)
    out = scene_.make(type, slot, list);
  else
    out = scene_.make(type, slot, list.empty() ? NodeId{} : list[0]);
  return true;
}

}  // namespace

void parse_vrml1(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene,
                 Diagnostics& diag) {
  Vrml1Parser(text, base, limits, scene, diag).file();
}

}  // namespace wrlkit::vrml

// What a file declares: the interfaces of prototypes and Scripts, ROUTEs, IMPORTs and EXPORTs.
#include <algorithm>

#include "parsers/vrml/grammar.h"

namespace wrlkit::vrml {

bool Parser::declaration_follows(Token access) {
  auto at = lex_.offset();
  lex_.seek(access.end);
  Token type = lex_.next(), name = lex_.next();
  lex_.seek(at);
  FieldType t;
  return type.kind == Kind::word && name.kind == Kind::word && find_field_type(text(type), t);
}

bool Parser::declaration(Access access, bool with_value, FieldDef& f, Token& name) {
  Token type = lex_.next();
  if (type.kind != Kind::word || !find_field_type(text(type), f.type)) {
    expected("a field type", type);
    if (type.kind != Kind::word) lex_.seek(type.begin);
    return false;
  }
  name = lex_.peek();
  if (name.kind != Kind::word) {
    expected("a name", name);
    return false;
  }
  lex_.next();
  f.name = scene_.keep(new_name(name));
  f.access = access;
  f.dialects = 0xff;
  f.default_value = empty_value(f.type);
  if (with_value && f.has_value()) {
    Value v;
    if (value(f.type, Value::extra_slot, f.name, f.default_value, v)) f.default_value = v;
  }
  return true;
}

Parser::Interface Parser::interface(bool with_values) {
  Interface out;
  if (Token t = lex_.peek(); t.kind != Kind::open_bracket) {
    expected("'['", t);
    return out;
  }
  Token opened = lex_.next();
  for (;;) {
    Token t = lex_.next();
    if (t.kind == Kind::close_bracket) return out;
    if (t.kind == Kind::end) {
      unclosed(opened);
      return out;
    }
    if (t.kind == Kind::open_brace || t.kind == Kind::close_brace) {
      reject("']'", t);
      return out;
    }
    auto access = t.kind == Kind::word ? find_access(text(t)) : std::nullopt;
    if (!access) {
      diag_.report(Diag::stray_token, span(t), describe(t));
      continue;
    }
    FieldDef f{};
    Token name;
    if (!declaration(*access, with_values, f, name)) continue;
    if (out.fields.size() >= SceneBuilder::most_fields) {
      diag_.report(Diag::expansion_limit, span(name), SceneBuilder::most_fields, "fields");
    } else if (!out.names.insert(f.name).second) {
      diag_.report(Diag::duplicate_field, span(name), f.name, "the first one counts");
    } else {
      f.default_value.slot = static_cast<std::uint16_t>(out.fields.size());
      out.fields.push_back(f);
    }
  }
}

void Parser::proto(Token keyword) {
  Token name = lex_.next();
  if (!name_like(name)) {
    reject("a name", name);
    return;
  }
  auto proto_name = new_name(name);
  auto declared = interface(true);
  Proto p;
  p.where = span(keyword);
  if (Token t = lex_.peek(); t.kind != Kind::open_brace) {
    expected("'{'", t);
  } else if (scope_depth_ + build_.depth() >= limits_.depth) {
    diag_.report(Diag::too_deep, span(name), limits_.depth);
    lex_.next();
    skip_to_close(Kind::open_brace, Kind::close_brace);
  } else {
    lex_.next();
    ++scope_depth_;
    build_.open_scope();
    interfaces_.push_back(&declared);
    statements(Kind::close_brace);
    interfaces_.pop_back();
    p.body = build_.close_scope();
    --scope_depth_;
  }
  if (p.body.roots.empty()) diag_.report(Diag::empty_proto, span(name), proto_name);
  p.type = build_.proto_type(proto_name, declared.fields);
  build_.declare_proto(std::move(p), span(name));
}

void Parser::externproto(Token keyword) {
  Token name = lex_.next();
  if (!name_like(name)) {
    reject("a name", name);
    return;
  }
  auto declared = interface(false);
  Proto p;
  p.where = span(keyword);
  p.external = true;
  Value urls;
  if (string_list(FieldType::MFString, 0, urls)) p.urls.assign(urls.text_span().begin(), urls.text_span().end());
  p.type = build_.proto_type(new_name(name), declared.fields);
  build_.declare_proto(std::move(p), span(name));
}

// A field that a Script declares: `field SFInt32 n 3`, `eventIn SFBool go IS start`. Other nodes cannot, but unknown
// ones of extensions do.
void Parser::script_declaration(Access access, Token keyword) {
  const auto& type = build_.current_type();
  if (type.name != "Script") {
    if (!type.takes_any_field()) diag_.report(Diag::unknown_field, span(keyword), type.name, text(keyword));
    undeclarable(access, keyword);
    return;
  }
  FieldDef f{};
  Token name;
  if (!declaration(access, false, f, name)) return;
  auto declared = build_.declare(f, span(keyword));
  if (!declared) {  // its value is read and dropped
    Value dropped;
    if (f.has_value()) value(f.type, Value::extra_slot, f.name, f.default_value, dropped);
    return;
  }
  std::uint16_t slot = *declared;
  if (is_clause(f.type, slot) || !f.has_value()) return;
  Value v;
  if (value(f.type, slot, f.name, f.default_value, v))
    build_.field(v, span(name));
  else
    build_.field(
        [&] {
          Value e = f.default_value;
          e.slot = slot;
          return e;
        }(),
        span(name));
}

// `field SFInt32 n 3` in a node that cannot declare fields: kept as a field of the name "field SFInt32 n".
void Parser::undeclarable(Access access, Token keyword) {
  Token type = lex_.next(), name = lex_.next();
  FieldType t{};
  find_field_type(text(type), t);
  std::string full = std::string(text(keyword)) + ' ' + std::string(text(type)) + ' ' + std::string(name_of(name));
  Value v;
  const bool is = text(lex_.peek()) == "IS";
  if (is)
    v = is_value(lex_.next(), t, Value::extra_slot);
  else if (access == Access::in || access == Access::out)
    v = scene_.make(FieldType::verbatim, Value::extra_slot, std::string_view{});
  else if (!value(t, Value::extra_slot, text(name), empty_value(t), v))
    return;
  if (!is || v.is) build_.field(scene_.make_extra(full, v), span(keyword));
}

void Parser::route_statement(Token keyword) {
  std::string_view from, out, to, in;
  if (!route_end(from, out)) return;
  if (Token t = lex_.peek(); text(t) == "TO" || text(t) == "to") {
    lex_.next();
  } else {
    expected("TO", t);
    if (text(t).find('.') == std::string_view::npos) return;
  }
  if (!route_end(to, in)) return;
  build_.route(from, out, to, in, span(keyword));
}

// node.event; blanks around the point occur.
bool Parser::route_end(std::string_view& node, std::string_view& event) {
  Token t = lex_.peek();
  if (t.kind != Kind::word || node_follows(t)) {
    expected("a node and its event", t);
    return false;
  }
  lex_.next();
  const std::string_view w = name_of(t);
  const auto point = w.rfind('.');
  node = w.substr(0, point);
  if (point != w.npos && point > 0 && point + 1 < w.size()) {
    event = w.substr(point + 1);
    return true;
  }
  Token e = lex_.peek();
  if (e.kind == Kind::word && point == w.npos && !text(e).starts_with('.')) {
    lex_.next();
    expected("'.'", e);
    return false;
  }
  if (point == w.npos && text(e) == ".") {
    lex_.next();
    e = lex_.peek();
  }
  if (e.kind != Kind::word) {
    expected("an event", e);
    return false;
  }
  lex_.next();
  event = name_of(e);
  if (point == w.npos && event.starts_with('.')) event.remove_prefix(1);
  if (!event.empty() && event.find('.') == event.npos) return true;
  expected("an event", e);
  return false;
}

// EXPORT name AS name, IMPORT inline.name AS name: X3D's, found in VRML97 files as well. Without AS the name stays.
void Parser::import_export(Token keyword) {
  const bool import = text(keyword) == "IMPORT";
  std::string_view node, name;
  if (import && !route_end(node, name)) return;
  if (!import) {
    Token t = lex_.peek();
    if (t.kind != Kind::word || node_follows(t)) return expected("a name", t);
    lex_.next();
    node = name = name_of(t);
  }
  const auto exported = name;
  if (text(lex_.peek()) == "AS") {
    lex_.next();
    Token t = lex_.peek();
    if (t.kind != Kind::word) return expected("a name", t);
    lex_.next();
    name = new_name(t);
  }
  if (scene_.dialect() != Dialect::x3d)
    diag_.report(Diag::dialect_statement, span(keyword), text(keyword), "it is dropped");
  else if (import)
    build_.import_name(node, exported, name, span(keyword));
  else
    build_.export_name(node, name, span(keyword));
}

}  // namespace wrlkit::vrml

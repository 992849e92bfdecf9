#include "parsers/vrml/parser.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "parsers/vrml/grammar.h"

namespace wrlkit::vrml {
namespace {

/// As all words are that begin a statement, and few others.
bool has_capitals(std::string_view word) {
  auto capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  return word.size() >= 4 && capital(word[0]) && capital(word[1]);
}

bool begins_statement(std::string_view word) {
  if (!has_capitals(word)) return false;
  return word == "PROTO" || word == "EXTERNPROTO" || word == "ROUTE" || word == "IMPORT" || word == "EXPORT";
}

bool begins_head(std::string_view word) {
  if (!has_capitals(word)) return false;
  return word == "PROFILE" || word == "COMPONENT" || word == "META" || word == "UNIT";
}

}  // namespace

// ---- statements ----------------------------------------------------------------------------------------------------

bool Parser::vrml_scene() {
  statements(Kind::end);
  scene_.main = build_.close_scope();
  if (lists_ && !lists_->finish(scene_)) return false;
  apply(units_, scene_, diag_);
  return true;
}

bool Parser::node_follows(Token name) const {
  if (!name_like(name)) return false;
  auto w = text(name);
  if (w == "DEF" || w == "USE" || w == "NULL") return true;
  return !begins_statement(w) && lex_.brace_follows(name);
}

void Parser::statements(Kind until) {
  NodePattern& before = begin_pattern();
  for (;;) {
    Token t = lex_.peek();
    if (t.kind == until) {
      lex_.next();
      return;
    }
    if (t.kind == Kind::end) {
      diag_.report(Diag::unclosed, span(t), "{");
      return;
    }
    if (statement(t)) {
      before.forget();  // the same words may mean another thing now
      continue;
    }
    if (name_like(t)) {
      auto at = lex_.offset();
      const auto mark = misplaced_.size();
      NodeId n = next_node(until == Kind::end, before);
      if (n) build_.root(n);
      take_misplaced(mark, [&](NodeId m) { build_.root(m); });
      if (n || lex_.offset() != at) continue;
    }
    stray();
  }
}

bool Parser::statement(Token t) {
  if (t.kind != Kind::word) return false;
  auto w = text(t);
  if (begins_head(w) && !node_follows(t)) {
    ++n_statements_;
    lex_.next();
    if (scene_.dialect() != Dialect::x3d) diag_.report(Diag::dialect_statement, span(t), w, "it is read as in X3D");
    head_statement(t);
    return true;
  }
  if (!begins_statement(w)) return false;
  ++n_statements_;
  lex_.next();
  if (w == "PROTO")
    proto(t);
  else if (w == "EXTERNPROTO")
    externproto(t);
  else if (w == "ROUTE")
    route_statement(t);
  else
    import_export(t);
  return true;
}

// PROFILE Immersive, COMPONENT Navigation:2, META "name" "content", UNIT length inch 0.0254 (ISO/IEC 19776-2, 5.2).
void Parser::head_statement(Token keyword) {
  const auto w = text(keyword);
  if (w == "PROFILE") {
    scene_.x3d.profile = word_or_string();
  } else if (w == "META") {
    auto name = word_or_string();
    scene_.x3d.meta.emplace_back(name, word_or_string());
  } else if (w == "COMPONENT") {
    std::string c(word_or_string());
    // Blanks around the colon occur.
    while ((c.find(':') == c.npos && text(lex_.peek()).starts_with(':')) || c.ends_with(':')) c += word_or_string();
    auto colon = c.find(':');
    scene_.x3d.components.emplace_back(c.substr(0, colon), colon == c.npos ? 1 : std::atoi(c.c_str() + colon + 1));
  } else {
    auto category = word_or_string();
    word_or_string();
    Token factor = lex_.peek();
    numbers_.clear();
    read_numbers(FieldType::SFDouble, 1);
    if (numbers_.empty() || !units_.set(category, numbers_.back()))
      diag_.report(Diag::unit_dropped, span(factor), category, describe(factor));
  }
}

std::string_view Parser::word_or_string() {
  Token t = lex_.peek();
  std::string_view s;
  if (t.kind == Kind::string) {
    string_token(s);
    return s;
  }
  if (t.kind != Kind::word) {
    expected("a word", t);
    return s;
  }
  lex_.next();
  return name_of(t);
}

void Parser::stray() {
  Token first = lex_.peek();
  diag_.report(Diag::stray_token, span(first), describe(first));
  do {
    Token t = lex_.next();
    if (t.kind == Kind::open_brace) skip_to_close(Kind::open_brace, Kind::close_brace);
    if (t.kind == Kind::open_bracket) skip_to_close(Kind::open_bracket, Kind::close_bracket);
  } while (is_stray(lex_.peek()));
}

// ---- nodes ---------------------------------------------------------------------------------------------------------

NodeId Parser::node_statement() {
  Token t = lex_.next();
  auto w = text(t);
  if (w == "NULL") return {};
  if (w == "USE") {
    Token name = lex_.next_name();
    if (!is_word(name)) return NodeId{};
    return build_.use(name_of(name), span(name));
  }
  std::string_view def;
  while (text(t) == "DEF") {
    if (!def.empty()) diag_.report(Diag::def_without_node, span(t), def);
    Token name = lex_.next_name();
    if (!is_word(name)) return NodeId{};
    if (name_like(name) && !begins_statement(text(name)) &&
        lex_.peek().kind == Kind::open_brace) {  // "DEF Transform {": the name is missing
      diag_.report(Diag::def_without_name, span(name));
      lex_.next();
      return node(name, {});
    }
    def = new_name(name);
    t = lex_.next();
  }
  if (!def.empty() && (text(t) == "USE" || !name_like(t))) {
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

NodeId Parser::node(Token type_name, std::string_view def) {
  if (build_.depth() + scope_depth_ >= limits_.depth || scene_.node_count() >= limits_.nodes) {
    diag_.report(Diag::too_deep, span(type_name), limits_.depth);
    skip_to_close(Kind::open_brace, Kind::close_brace);
    return {};
  }
  const TypeId type = node_type(type_name, std::exchange(among_children_, false));
  NodeId n = build_.open(type, def, span(type_name));
  node_body(type_name);
  build_.close();
  if (part_read_) tell_part_read();
  return n;
}

void Parser::tell_part_read() {
  constexpr std::uint32_t step = 2 << 20;  // bytes
  const auto now = lex_.offset();
  if (now < told_ + std::uint64_t{step}) return;
  (*part_read_)(lex_.text(told_, now));
  told_ = now;
}

void Parser::node_body(Token opened) {
  for (;;) {
    Token t = lex_.peek();
    if (ends(t, Kind::close_brace, opened)) return;
    if (t.kind == Kind::close_bracket && open_lists_ > 0) {  // of a list that holds this node: its brace is missing
      expected("'}'", t);
      return;
    }
    if (t.kind == Kind::open_brace) {
      expected("a field", t);
      lex_.next();
      skip_to_close(Kind::open_brace, Kind::close_brace);
      continue;
    }
    if (!name_like(t) || is_stray(t)) {
      stray();
      continue;
    }
    if (!statement(t)) node_body_element(t);
  }
}

void Parser::node_body_element(Token t) {
  const auto& type = build_.current_type();
  auto w = text(t);
  if (auto slot = type.find(w, scene_.dialect())) {
    lex_.next();
    known_field(*slot, type.fields[*slot], t);
    return;
  }
  if (auto access = find_access(w)) {
    const bool declares = declaration_follows(t);
    lex_.next();
    if (declares)
      script_declaration(*access, t);
    else
      expected("a field type and a name", lex_.peek());
    return;
  }
  if (node_follows(t)) {
    implicit_child(t);
    return;
  }
  lex_.next();
  unknown_field(t);
}

// A node where a field belongs, as VRML 1.0 had it: a child of a grouping node.
void Parser::implicit_child(Token t) {
  const auto& type = build_.current_type();
  auto slot = type.find("children", scene_.dialect());
  if (slot && type.fields[*slot].type == FieldType::MFNode) {
    if (!in_vrml1()) diag_.report(Diag::implicit_child, span(t), describe(t));
    if (NodeId n = child_statement()) build_.append_child(*slot, shape_around(n));
  } else if (auto w = text(t); w == "USE" || w == "NULL") {
    diag_.report(Diag::stray_token, span(t), describe(t));
    node_statement();
  } else {
    diag_.report(Diag::misplaced_node, span(t), describe(t));
    if (NodeId n = child_statement()) misplaced_.push_back(n);
  }
}

// ---- fields --------------------------------------------------------------------------------------------------------

void Parser::known_field(std::uint16_t slot, const FieldDef& def, Token name) {
  if (is_clause(def.type, slot)) return;
  if (!def.has_value()) {
    // A value for an event: kept like an unknown field, so that nothing is lost.
    unknown_field(name);
    return;
  }
  if (lists_ && deferred_list(def.type, slot, name)) return;
  Value v;
  last_list_ = {};
  if (!value(def.type, slot, def.name_in(scene_.dialect()), def.default_value, v)) return;
  const auto& t = info(def.type);
  const bool numbers = t.multiple && (t.element == Element::number || t.element == Element::integer);
  if (numbers && last_list_.data() && !in_vrml1()) lists_met_.push_back({last_list_, build_.current(), slot, def.type});
  build_.field(v, span(name));
}

bool Parser::deferred_list(FieldType type, std::uint16_t slot, Token name) {
  const auto& t = info(type);
  const Token opened = lex_.peek();
  if (!t.multiple || type == FieldType::MFBool || opened.kind != Kind::open_bracket) return false;
  if (t.element != Element::number && t.element != Element::integer) return false;
  const auto rest = lex_.text(opened.end, lex_.size());
  const auto length = rest.find(']');
  if (length == rest.npos) lists_->give_up();  // and look no further for brackets that are not there
  if (length == rest.npos || length < RepeatedLists::shortest) return false;
  lex_.seek(opened.end + static_cast<std::uint32_t>(length) + 1);
  lists_met_.push_back({rest.substr(0, length), build_.current(), slot, type});
  build_.field(lists_->add(rest.substr(0, length), type, slot, build_.current()), span(name));
  if (lists_->failed()) lex_.seek(lex_.size());
  return true;
}

bool Parser::is_clause(FieldType type, std::uint16_t slot) {
  if (text(lex_.peek()) != "IS") return false;
  Token is = lex_.next();
  Value v = is_value(is, type, slot);
  if (v.is) build_.field(v, span(is));
  return true;
}

Value Parser::is_value(Token is, FieldType type, std::uint16_t slot) {
  Value v;
  Token name = lex_.next();
  if (!is_word(name)) return v;
  if (interfaces_.empty()) {
    diag_.report(Diag::is_outside, span(is));
    return v;
  }
  if (!interfaces_.back()->names.contains(text(name))) diag_.report(Diag::unknown_is, span(name), text(name));
  v = scene_.make(FieldType::verbatim, slot, name_of(name));
  v.type = type;
  v.is = true;
  return v;
}

// A field that the node type does not have. Nodes in it are read, so that the geometry below unknown nodes is kept and
// DEF names in it are known; anything else is kept as text.
void Parser::unknown_field(Token name) {
  const auto& type = build_.current_type();
  auto field_name = name_of(name);
  Value v;
  bool is = text(lex_.peek()) == "IS";
  // set_x IS y and x_changed IS y of an exposedField are in order.
  if (!type.takes_any_field() && !(is && type.find(field_name, scene_.dialect(), true)))
    diag_.report(Diag::unknown_field, span(name), type.name, text(name));
  if (is) {
    v = is_value(lex_.next(), FieldType::verbatim, Value::extra_slot);
    if (v.is) build_.field(scene_.make_extra(field_name, v), span(name));
    return;
  }
  Token t = lex_.peek();
  if (node_follows(t)) {
    NodeId n = node_statement();
    build_.field(scene_.make_extra(field_name, scene_.make(FieldType::SFNode, Value::extra_slot, n)), span(name));
    return;
  }
  if (t.kind == Kind::open_bracket && node_list_follows()) {
    if (!value(FieldType::MFNode, Value::extra_slot, field_name, {}, v)) return;
    if (v.count == 0) v = scene_.make(FieldType::verbatim, Value::extra_slot, "[]");  // what an empty list reads as
    build_.field(scene_.make_extra(field_name, v), span(name));
    return;
  }
  auto s = verbatim();
  build_.field(scene_.make_extra(field_name, scene_.make(FieldType::verbatim, Value::extra_slot, s)), span(name));
}

// ---- values --------------------------------------------------------------------------------------------------------

bool Parser::value(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out) {
  const auto& t = info(type);
  const bool read = t.element == Element::node ? (t.multiple ? node_list(slot, out) : single_node(slot, field, out))
                    : in_vrml1()               ? vrml1_value(type, slot, field, fallback, out)
                                               : plain_value(type, slot, field, fallback, out);
  if (!read) skip_values();
  return read;
}

bool parse_on_threads(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene,
                      Diagnostics& diag, const PartRead& part_read) {
  Scene read = scene;
  Diagnostics said = diag;
  DeferredLists lists(text, part_read);
  if (!Parser(text, base, limits, read, said, &lists).vrml_scene()) return false;
  scene = std::move(read);
  diag = std::move(said);
  return true;
}

void parse(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag,
           const PartRead& part_read) {
  const bool threads = text.size() >= DeferredLists::from_bytes && !only_one_thread();
  if (threads && parse_on_threads(text, base, limits, scene, diag, part_read)) return;
  Parser parser(text, base, limits, scene, diag);
  if (part_read) parser.set_part_read(&part_read);
  parser.vrml_scene();
}

}  // namespace wrlkit::vrml

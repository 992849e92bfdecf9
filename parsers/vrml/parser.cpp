// Recursive descent over the grammar of annex A; functions carry the names of its productions. A function that meets a
// fault reports it once and returns; the caller that owns the brace skips to it.
#include "parsers/vrml/parser.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <unordered_set>

#include "parsers/vrml/lexer.h"
#include "parsers/vrml/number.h"
#include "parsers/vrml/text_encoding.h"
#include "scenegraph/nodes.h"

namespace wrlkit::vrml {
namespace {

struct AccessWord {
  std::string_view word;
  Access access;
};
// X3D's words occur in files that were converted half-way.
constexpr AccessWord access_words[] = {
    {"eventIn", Access::in}, {"eventOut", Access::out}, {"field", Access::init}, {"exposedField", Access::inout},
    {"inputOnly", Access::in}, {"outputOnly", Access::out}, {"initializeOnly", Access::init}, {"inputOutput", Access::inout}};

const AccessWord* find_access(std::string_view word) {
  auto i = std::ranges::find(access_words, word, &AccessWord::word);
  return i == std::end(access_words) ? nullptr : i;
}

class Parser {
 public:
  Parser(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag)
      : lex_(text), base_(base), limits_(limits), scene_(scene), diag_(diag), build_(scene, diag) {}

  void vrml_scene() {
    statements(Kind::end);
    scene_.main = build_.close_scope();
  }

 private:
  // ---- tokens ------------------------------------------------------------------------------------------------------
  Span span(Token t) const { return {base_ + t.begin, t.end - t.begin}; }
  std::string_view text(Token t) const { return lex_.text(t); }
  std::string describe(Token t) const { return t.kind == Kind::end ? "the end of the file" : "'" + std::string(text(t).substr(0, 60)) + "'"; }
  bool take(Kind k) { return lex_.peek().kind == k && (lex_.next(), true); }
  void expected(std::string_view what, Token found) { diag_.report(Diag::syntax, span(found), what, describe(found)); }
  bool name_like(Token t) const {
    if (t.kind != Kind::word) return false;
    char c = text(t)[0];
    return !(c >= '0' && c <= '9') && c != '+' && c != '-' && c != '.';
  }
  bool node_follows(Token name) {
    if (!name_like(name)) return false;
    auto w = text(name);
    if (w == "DEF" || w == "USE" || w == "NULL") return true;
    auto at = lex_.offset();
    lex_.seek(name.end);
    bool brace = lex_.peek().kind == Kind::open_brace;
    lex_.seek(at);
    return brace;
  }

  /// Skips to behind the bracket that closes the one just read. False: the text ended first.
  bool skip_to_close(Kind open, Kind close) {
    for (std::size_t depth = 1;;) {
      Token t = lex_.next();
      if (t.kind == Kind::end) return false;
      if (t.kind == open) ++depth;
      if (t.kind == close && --depth == 0) return true;
    }
  }

  std::string_view utf8(std::string_view s, Span where) {
    if (is_utf8(s)) return s;
    diag_.report(Diag::encoding_repaired, where, "Latin-1");
    return scene_.keep(latin1_to_utf8(s));
  }

  std::string_view name_of(Token t) { return utf8(text(t), span(t)); }

  /// A name that is being defined: DEF, PROTO, field.
  std::string_view new_name(Token t) {
    auto s = text(t);
    if (s.find_first_of("'\\") != s.npos || !name_like(t)) diag_.report(Diag::name_repaired, span(t), s);
    return name_of(t);
  }

  // ---- statements --------------------------------------------------------------------------------------------------
  // Also the body of a PROTO, which ends with a brace.
  void statements(Kind until) {
    for (;;) {
      Token t = lex_.peek();
      if (t.kind == until) { lex_.next(); return; }
      if (t.kind == Kind::end) { diag_.report(Diag::unclosed, span(t), "{"); return; }
      if (statement(t)) continue;
      if (name_like(t)) {
        auto at = lex_.offset();
        const auto mark = misplaced_.size();
        NodeId n = node_statement();
        if (n) build_.root(n);
        take_misplaced(mark, [&](NodeId m) { build_.root(m); });
        if (n || lex_.offset() != at) continue;
      }
      stray();
    }
  }

  /// PROTO, EXTERNPROTO and ROUTE, which may stand between nodes and between fields.
  bool statement(Token t) {
    if (t.kind != Kind::word) return false;
    auto w = text(t);
    if (w != "PROTO" && w != "EXTERNPROTO" && w != "ROUTE" && w != "IMPORT" && w != "EXPORT") return false;
    lex_.next();
    if (w == "PROTO") proto(t);
    else if (w == "EXTERNPROTO") externproto(t);
    else if (w == "ROUTE") route_statement(t);
    else skip_import_export(t);
    return true;
  }

  /// EXPORT name AS name, IMPORT inline.name AS name: X3D's, found in VRML97 files as well.
  void skip_import_export(Token keyword) {
    diag_.report(Diag::dialect_statement, span(keyword), text(keyword));
    lex_.next();
    if (text(lex_.peek()) == "AS") lex_.next(), lex_.next();
  }

  /// Something that fits nowhere: skipped with everything it brackets, one message for a run of them.
  void stray() {
    Token first = lex_.peek();
    diag_.report(Diag::stray_token, span(first), describe(first));
    do {
      Token t = lex_.next();
      if (t.kind == Kind::open_brace) skip_to_close(Kind::open_brace, Kind::close_brace);
      if (t.kind == Kind::open_bracket) skip_to_close(Kind::open_bracket, Kind::close_bracket);
    } while (is_stray(lex_.peek()));
  }
  bool is_stray(Token t) const { return t.kind == Kind::string || t.kind == Kind::open_bracket || (t.kind == Kind::word && !name_like(t)); }

  // ---- nodes -------------------------------------------------------------------------------------------------------
  /// nodeStatement, or NULL. None when there is no node; then nothing but a faulty token was consumed.
  NodeId node_statement() {
    Token t = lex_.next();
    auto w = text(t);
    if (w == "NULL") return {};
    if (w == "USE") {
      Token name = lex_.next();
      if (name.kind != Kind::word) return expected("a name", name), lex_.seek(name.begin), NodeId{};
      return build_.use(name_of(name), span(name));
    }
    std::string_view def;
    while (text(t) == "DEF") {
      if (!def.empty()) diag_.report(Diag::def_without_node, span(t), def);
      Token name = lex_.next();
      if (name.kind != Kind::word) return expected("a name", name), lex_.seek(name.begin), NodeId{};
      if (lex_.peek().kind == Kind::open_brace) {  // "DEF Transform {": the name is missing
        diag_.report(Diag::def_without_name, span(name));
        return lex_.next(), node(name, {});
      }
      def = new_name(name);
      t = lex_.next();
    }
    if (!def.empty() && (text(t) == "USE" || !name_like(t))) return expected("a node", t), lex_.seek(t.begin), NodeId{};
    if (Token brace = lex_.peek(); brace.kind != Kind::open_brace) return expected("'{'", brace), NodeId{};
    lex_.next();
    return node(t, def);
  }

  NodeId node(Token type_name, std::string_view def) {
    if (build_.depth() + scope_depth_ >= limits_.depth || scene_.node_count() >= limits_.nodes) {
      diag_.report(Diag::too_deep, span(type_name), limits_.depth);
      skip_to_close(Kind::open_brace, Kind::close_brace);
      return {};
    }
    TypeId type = build_.type(name_of(type_name), span(type_name));
    NodeId n = build_.open(type, def, span(type_name));
    node_body(type_name);
    build_.close();
    return n;
  }

  void node_body(Token opened) {
    for (;;) {
      Token t = lex_.peek();
      if (t.kind == Kind::close_brace) { lex_.next(); return; }
      if (t.kind == Kind::end) { unclosed(opened); return; }
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
      if (!name_like(t)) { stray(); continue; }
      if (!statement(t)) node_body_element(t);
    }
  }

  // At the end of the file every open node is unclosed; one message is enough.
  void unclosed(Token opened) {
    if (!unclosed_) diag_.report(Diag::unclosed, span(opened), text(opened));
    unclosed_ = true;
  }

  void node_body_element(Token t) {
    const auto& type = build_.current_type();
    auto w = text(t);
    if (auto slot = type.find(w, scene_.dialect())) {
      lex_.next();
      known_field(*slot, type.fields[*slot], t);
      return;
    }
    if (auto* a = find_access(w); a && declaration_follows(t)) {
      lex_.next();
      script_declaration(*a, t);
      return;
    }
    if (node_follows(t)) { implicit_child(t); return; }
    lex_.next();
    unknown_field(t);
  }

  /// A node where a field belongs, as VRML 1.0 had it: a child of a grouping node.
  void implicit_child(Token t) {
    const auto& type = build_.current_type();
    auto slot = type.find("children", scene_.dialect());
    if (slot && type.fields[*slot].type == FieldType::MFNode) {
      diag_.report(Diag::implicit_child, span(t), describe(t));
      if (NodeId n = node_statement()) build_.append_child(*slot, shape_around(n));
    } else if (auto w = text(t); w == "USE" || w == "NULL") {
      diag_.report(Diag::stray_token, span(t), describe(t));
      node_statement();
    } else {
      diag_.report(Diag::misplaced_node, span(t), describe(t));
      if (NodeId n = node_statement()) misplaced_.push_back(n);
    }
  }

  /// Gives the nodes that were met in places for no node since `mark`: mostly the closing brace of the one before them is
  /// missing, so that they belong into the list that it is in.
  template <class F>
  void take_misplaced(std::size_t mark, F&& take) {
    std::for_each(misplaced_.begin() + static_cast<std::ptrdiff_t>(mark), misplaced_.end(), take);
    misplaced_.resize(mark);
  }

  bool declaration_follows(Token access) {
    auto at = lex_.offset();
    lex_.seek(access.end);
    Token type = lex_.next(), name = lex_.next();
    lex_.seek(at);
    FieldType t;
    return type.kind == Kind::word && name.kind == Kind::word && find_field_type(text(type), t);
  }

  // ---- fields ------------------------------------------------------------------------------------------------------
  void known_field(std::uint16_t slot, const FieldDef& def, Token name) {
    if (is_clause(def.type, slot)) return;
    if (!def.has_value()) {
      // A value for an event: kept like an unknown field, so that nothing is lost.
      unknown_field(name);
      return;
    }
    Value v;
    if (value(def.type, slot, def.name_in(scene_.dialect()), def.default_value, v)) build_.field(v, span(name));
  }

  /// `IS name` behind a field name. True when it was one.
  bool is_clause(FieldType type, std::uint16_t slot) {
    if (text(lex_.peek()) != "IS") return false;
    Token is = lex_.next();
    Value v = is_value(is, type, slot);
    if (v.is) build_.field(v, span(is));
    return true;
  }

  Value is_value(Token is, FieldType type, std::uint16_t slot) {
    Value v;
    Token name = lex_.next();
    if (name.kind != Kind::word) return expected("a name", name), lex_.seek(name.begin), v;
    if (interfaces_.empty()) return diag_.report(Diag::is_outside, span(is)), v;
    if (std::ranges::find(*interfaces_.back(), text(name), &FieldDef::name) == interfaces_.back()->end()) diag_.report(Diag::unknown_is, span(name), text(name));
    v = scene_.make(FieldType::verbatim, slot, name_of(name));
    v.type = type;
    v.is = true;
    return v;
  }

  /// A field that the node type does not have. Nodes in it are read, so that the geometry below unknown nodes is had and
  /// DEF names in it are known; anything else is kept as text.
  void unknown_field(Token name) {
    const auto& type = build_.current_type();
    auto field_name = name_of(name);
    Value v;
    bool is = text(lex_.peek()) == "IS";
    // set_x IS y and x_changed IS y of an exposedField are in order.
    if (type.kind != NodeKind::unknown && !(is && type.find(field_name, scene_.dialect(), true))) diag_.report(Diag::unknown_field, span(name), type.name, text(name));
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

  bool node_list_follows() {
    auto at = lex_.offset();
    lex_.next();
    Token first = lex_.peek();
    bool yes = node_follows(first);
    lex_.seek(at);
    return yes;
  }

  /// Text of values up to the next name or bracket that ends them. What is left open in it is closed, so that it can stand
  /// before other text.
  std::string verbatim() {
    Token first = lex_.peek();
    std::uint32_t end = first.begin;
    std::string closing;
    while (closing.empty()) {
      Token t = lex_.peek();
      if (t.kind == Kind::open_bracket) {
        lex_.next();
        if (auto missing = skip_list()) {
          if (Token stop = lex_.peek(); stop.kind == Kind::end) unclosed(t);
          else expected("']'", stop);
          closing = '\n' + std::string(missing, ']');  // a comment may come before
        }
      } else if (t.kind == Kind::string) {
        lex_.next();
        if (!lex_.closed(t)) unclosed_string(t);
      } else if (t.kind == Kind::word && (!name_like(t) || text(t) == "TRUE" || text(t) == "FALSE")) {
        lex_.next();
      } else {
        break;
      }
      end = lex_.offset();
    }
    auto value = lex_.text(first.begin, end);
    std::string out(utf8(value, span(first)));
    if (end == lex_.size() && !value.empty() && open_string_) {
      bool escapes = (value.size() - 1 - value.find_last_not_of('\\')) % 2;
      out += escapes ? "\\\"" : "\"";
    }
    return out + closing;
  }

  // ---- values ------------------------------------------------------------------------------------------------------
  bool value(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out) {
    const auto& t = info(type);
    switch (t.element) {
      case Element::node: return t.multiple ? node_list(slot, out) : single_node(slot, field, out);
      case Element::text: return t.multiple ? string_list(type, slot, out) : single_string(type, slot, field, out);
      case Element::image: return image(type, slot, out);
      case Element::integer:
      case Element::number: break;
    }
    auto& numbers = numbers_;
    auto& integers = integers_;
    numbers.clear();
    integers.clear();
    bool real = t.element == Element::number;
    bool boolean = type == FieldType::SFBool || type == FieldType::MFBool;
    auto count = [&] { return real ? numbers.size() : integers.size(); };
    auto read = [&](bool all) { return boolean ? booleans(all) : real ? doubles(all ? 0 : t.arity) : int32s(all ? 0 : 1); };
    Token first = lex_.peek();
    if (first.kind == Kind::open_bracket) {
      lex_.next();
      read(true);
      close_list(first);
      if (!t.multiple) diag_.report(Diag::extra_bracket, span(first), field);
    } else {
      // One value needs no brackets; more of them in an MF field are a habit of hand-written files.
      read(t.multiple);
      if (t.multiple && count() > t.arity) diag_.report(Diag::missing_bracket, span(first), field);
    }
    if (count() == 0 && !(t.multiple && first.kind == Kind::open_bracket)) return diag_.report(Diag::bad_value, span(first), describe(first), t.name), false;
    if (!t.multiple && count() != t.arity) fix_arity(t.arity, fallback, field, span(first));
    if (t.multiple && count() % t.arity) {
      diag_.report(Diag::missing_values, span(first), count(), field, static_cast<int>(t.arity));
      numbers.resize(numbers.size() - numbers.size() % t.arity);
    }
    if (!t.multiple && t.arity == 1) out = real ? scene_.make(type, slot, numbers[0]) : scene_.make(type, slot, integers[0]);
    else out = real ? scene_.make(type, slot, std::span<const double>(numbers)) : scene_.make(type, slot, std::span<const std::int32_t>(integers));
    return true;
  }

  void fix_arity(std::size_t arity, const Value& fallback, std::string_view field, Span where) {
    diag_.report(Diag::short_value, where, field);
    auto rest = fallback.number_span();
    while (numbers_.size() < arity) numbers_.push_back(numbers_.size() < rest.size() ? rest[numbers_.size()] : 0);
    numbers_.resize(arity);
    integers_.resize(std::min<std::size_t>(integers_.size(), arity));
  }

  /// Numbers up to the first thing that is none, `most` of them at the most (0: any number).
  bool doubles(std::size_t most) { return numbers(numbers_, read_double, most); }
  bool int32s(std::size_t most) { return numbers(integers_, read_int32, most); }

  template <class T, class Read>
  bool numbers(std::vector<T>& to, Read read, std::size_t most) {
    for (;;) {
      lex_.skip_blanks();
      const char *p = lex_.position(), *start = p;
      T v;
      auto r = read(p, lex_.limit(), v);
      if (r == NumberResult::none) return true;
      lex_.set_position(p);
      if (r == NumberResult::repaired) number_repaired(start, p, static_cast<double>(v));
      to.push_back(v);
      if (most && to.size() == most) return true;
    }
  }

  void number_repaired(const char* from, const char* to, double v) {
    std::uint32_t end = lex_.offset(), length = static_cast<std::uint32_t>(to - from);
    diag_.report(Diag::number_repaired, Span{base_ + end - length, length}, std::string_view(from, length), v);
  }

  bool booleans(bool all) {
    do {
      Token t = lex_.peek();
      auto w = text(t);
      bool yes = w == "TRUE" || w == "true" || w == "True" || w == "1" || w == "\"TRUE\"" || w == "\"true\"";
      bool no = w == "FALSE" || w == "false" || w == "False" || w == "0" || w == "\"FALSE\"" || w == "\"false\"";
      if (!yes && !no) return true;
      lex_.next();
      if (w != "TRUE" && w != "FALSE") diag_.report(Diag::bool_repaired, span(t), w, yes ? "TRUE" : "FALSE");
      integers_.push_back(yes);
    } while (all);
    return true;
  }

  /// Behind the values of a list: its ']', or else what is wrong, up to it.
  void close_list(Token opened) {
    Token t = lex_.peek();
    if (t.kind == Kind::close_bracket) { lex_.next(); return; }
    if (t.kind == Kind::end) { unclosed(opened); return; }
    expected("a number or ']'", t);
    if (t.kind == Kind::close_brace) return;  // the ']' is missing; the brace belongs to the node
    skip_list();
  }

  /// From inside a list behind its ']'; a brace that was not opened in it ends it, too. Returns how many ']' are missing.
  std::size_t skip_list() {
    for (std::size_t brackets = 1, braces = 0;;) {
      Token t = lex_.peek();
      if (t.kind == Kind::end || (t.kind == Kind::close_brace && braces == 0)) return brackets;
      lex_.next();
      if (t.kind == Kind::string && !lex_.closed(t)) unclosed_string(t);
      if (t.kind == Kind::open_brace) ++braces;
      if (t.kind == Kind::close_brace) --braces;
      if (t.kind == Kind::open_bracket) ++brackets;
      if (t.kind == Kind::close_bracket && --brackets == 0) return 0;
    }
  }

  /// width height components, then that many pixels. The numbers never decide how much is reserved.
  bool image(FieldType type, std::uint16_t slot, Value& out) {
    integers_.clear();
    Token first = lex_.peek();
    bool bracket = take(Kind::open_bracket);
    int32s(3);
    if (integers_.size() < 3 || integers_[0] < 0 || integers_[1] < 0) return diag_.report(Diag::bad_value, span(first), describe(first), info(type).name), false;
    auto side = [&](int i) { return static_cast<std::uint64_t>(std::max(0, integers_[i])); };
    std::uint64_t pixels = side(0) * side(1);
    if (pixels > lex_.size()) pixels = lex_.size();
    if (pixels) int32s(3 + pixels);
    if (integers_.size() != 3 + side(0) * side(1)) diag_.report(Diag::missing_values, span(first), integers_.size() - 3, "image", side(0) * side(1));
    if (bracket) { diag_.report(Diag::extra_bracket, span(first), "image"); close_list(first); }
    out = scene_.make(type, slot, std::span<const std::int32_t>(integers_));
    return true;
  }

  // ---- strings -----------------------------------------------------------------------------------------------------
  /// A quoted string without its quotes and escapes; a bare word is taken as one.
  bool string_token(std::string_view& out) {
    Token t = lex_.peek();
    if (t.kind == Kind::word && name_like(t)) {
      diag_.report(Diag::string_repaired, span(t), text(t));
      lex_.next();
      out = name_of(t);
      return true;
    }
    if (t.kind != Kind::string) return false;
    lex_.next();
    auto s = text(t).substr(1);
    if (lex_.closed(t)) s.remove_suffix(1);
    else unclosed_string(t);
    out = utf8(s, span(t));
    if (s.find('\\') == s.npos) return true;
    std::string plain;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (out[i] == '\\' && i + 1 < out.size() && (out[i + 1] == '"' || out[i + 1] == '\\')) ++i;
      plain += out[i];
    }
    out = scene_.keep(plain);
    return true;
  }

  void unclosed_string(Token t) {
    if (!unclosed_) diag_.report(Diag::unclosed_string, span({Kind::string, t.begin, t.begin + 1}));
    unclosed_ = open_string_ = true;
  }

  bool single_string(FieldType type, std::uint16_t slot, std::string_view field, Value& out) {
    Token t = lex_.peek();
    bool bracket = take(Kind::open_bracket);
    std::string_view s;
    if (!string_token(s)) {
      diag_.report(Diag::bad_value, span(t), describe(t), "SFString");
      if (bracket) skip_list();
      return false;
    }
    if (bracket) { diag_.report(Diag::extra_bracket, span(t), field); skip_list(); }
    out = scene_.make(type, slot, s);
    return true;
  }

  bool string_list(FieldType type, std::uint16_t slot, Value& out) {
    std::vector<std::string_view> list;
    Token first = lex_.peek();
    std::string_view s;
    if (first.kind != Kind::open_bracket) {
      if (first.kind != Kind::string) return diag_.report(Diag::bad_value, span(first), describe(first), "MFString"), false;
      while (lex_.peek().kind == Kind::string && string_token(s)) list.push_back(s);
      if (list.size() > 1) diag_.report(Diag::missing_bracket, span(first), "of strings");
    } else {
      lex_.next();
      while (string_token(s)) list.push_back(s);
      close_list(first);
    }
    out = scene_.make(type, slot, list);
    return true;
  }

  // ---- node values -------------------------------------------------------------------------------------------------
  bool single_node(std::uint16_t slot, std::string_view field, Value& out) {
    Token t = lex_.peek();
    NodeId n;
    if (t.kind == Kind::open_bracket && !node_list_follows()) {
      if (!property_node(slot, n)) return expected("a node", t), lex_.next(), skip_list(), false;
    } else if (t.kind == Kind::open_bracket) {
      Value list;
      diag_.report(Diag::extra_bracket, span(t), field);
      node_list(slot, list);
      if (list.count) n = list.nodes[0];
    } else if (name_like(t) && node_follows(t)) {
      n = node_statement();
    } else {
      return expected("a node", t), false;
    }
    out = scene_.make(FieldType::SFNode, slot, n);
    return true;
  }

  /// `color [ 1 0 0 ]` where a Color node belongs: the node that holds such a list and nothing else is put around it.
  bool property_node(std::uint16_t slot, NodeId& out) {
    if (build_.depth() == 0 || slot >= build_.current_type().fields.size()) return false;  // a field that the file declares
    const auto& def = build_.current_type().fields[slot];
    for (std::uint32_t i = 0; i < builtin_nodes().size(); ++i) {
      const auto& t = builtin_nodes()[i];
      bool fits = t.is_a("X3DGeometricPropertyNode") && t.fields.size() == 1 && std::ranges::any_of(def.kinds, [&](auto k) { return t.is_a(k); });
      if (!fits) continue;
      Token first = lex_.peek();
      diag_.report(Diag::list_repaired, span(first), t.name);
      out = build_.open(TypeId{i}, {}, span(first));
      known_field(0, t.fields[0], first);
      build_.close();
      return true;
    }
    return false;
  }

  /// The nodes are collected on one stack for all open lists.
  bool node_list(std::uint16_t slot, Value& out) {
    const auto mark = nodes_.size(), misplaced_before = misplaced_.size();
    Token first = lex_.peek();
    if (first.kind != Kind::open_bracket) {
      if (!name_like(first) || !node_follows(first)) return expected("a node or '['", first), false;
      if (NodeId n = node_statement()) nodes_.push_back(n);
    } else {
      lex_.next();
      ++open_lists_;
      list_elements(first);
      --open_lists_;
    }
    take_misplaced(misplaced_before, [&](NodeId m) { nodes_.push_back(m); });
    if (slot != Value::extra_slot && holds_children(slot))
      for (auto& n : std::span(nodes_).subspan(mark)) n = shape_around(n);
    out = scene_.make(FieldType::MFNode, slot, std::span<const NodeId>(nodes_).subspan(mark));
    nodes_.resize(mark);
    return true;
  }

  /// Geometry among children stands in a Shape of its own.
  bool holds_children(std::uint16_t slot) const {
    if (build_.depth() == 0 || slot >= build_.current_type().fields.size()) return false;
    auto kinds = build_.current_type().fields[slot].kinds;
    return std::ranges::find(kinds, "X3DChildNode") != kinds.end();
  }

  NodeId shape_around(NodeId n) {
    if (scene_.type(n).kind != NodeKind::builtin || !scene_.type(n).is_a("X3DGeometryNode")) return n;
    diag_.report(Diag::shape_repaired, scene_.where(n), scene_.type(n).name);
    NodeId shape = scene_.add(nodes::Shape, scene_.where(n));
    scene_.set(shape, nodes::shape::geometry, n);
    return shape;
  }

  void list_elements(Token opened) {
    for (;;) {
      Token t = lex_.peek();
      if (t.kind == Kind::close_bracket) { lex_.next(); return; }
      if (t.kind == Kind::end) { unclosed(opened); return; }
      if (t.kind == Kind::close_brace) { expected("']'", t); return; }  // the bracket is missing
      if (statement(t)) continue;
      if (name_like(t) && node_follows(t)) {
        if (text(t) == "NULL") diag_.report(Diag::null_repaired, span(t));
        const auto mark = misplaced_.size();
        if (NodeId n = node_statement()) nodes_.push_back(n);
        take_misplaced(mark, [&](NodeId m) { nodes_.push_back(m); });
        continue;
      }
      expected("a node", t);
      lex_.next();
      if (t.kind == Kind::open_brace) skip_to_close(Kind::open_brace, Kind::close_brace);
      if (t.kind == Kind::open_bracket) skip_to_close(Kind::open_bracket, Kind::close_bracket);
    }
  }

  // ---- prototypes and scripts --------------------------------------------------------------------------------------
  /// interfaceDeclaration without its access word. The default value goes into the FieldDef.
  bool declaration(Access access, bool with_value, FieldDef& f, Token& name) {
    Token type = lex_.next();
    if (type.kind != Kind::word || !find_field_type(text(type), f.type)) {
      expected("a field type", type);
      if (type.kind != Kind::word) lex_.seek(type.begin);
      return false;
    }
    name = lex_.peek();
    if (name.kind != Kind::word) return expected("a name", name), false;
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

  /// The value a field has when nobody gave one: zeroes and empty lists.
  Value empty_value(FieldType type) {
    const auto& t = info(type);
    static constexpr double zeros[16] = {};
    static constexpr std::int32_t no_pixels[3] = {};
    if (t.element == Element::text && !t.multiple) return scene_.make(type, 0, std::string_view{});
    if (t.element == Element::text) return scene_.make(type, 0, std::span<const std::string_view>{});
    if (t.element == Element::node) return scene_.make(type, 0, NodeId{});
    if (t.element == Element::image) return scene_.make(type, 0, std::span<const std::int32_t>(no_pixels));
    if (t.element == Element::integer) return t.multiple ? scene_.make(type, 0, std::span<const std::int32_t>{}) : scene_.make(type, 0, std::int32_t{0});
    return scene_.make(type, 0, std::span<const double>(zeros, t.multiple ? 0 : t.arity));
  }

  std::vector<FieldDef> interface(bool with_values) {
    std::vector<FieldDef> fields;
    std::unordered_set<std::string_view> names;
    if (Token t = lex_.peek(); t.kind != Kind::open_bracket) return expected("'['", t), fields;
    Token opened = lex_.next();
    for (;;) {
      Token t = lex_.next();
      if (t.kind == Kind::close_bracket) return fields;
      if (t.kind == Kind::end) return unclosed(opened), fields;
      if (t.kind == Kind::open_brace || t.kind == Kind::close_brace) return expected("']'", t), lex_.seek(t.begin), fields;
      auto* a = t.kind == Kind::word ? find_access(text(t)) : nullptr;
      if (!a) { diag_.report(Diag::stray_token, span(t), describe(t)); continue; }
      FieldDef f{};
      Token name;
      if (declaration(a->access, with_values, f, name)) {
        if (fields.size() >= SceneBuilder::most_fields) { diag_.report(Diag::expansion_limit, span(name), SceneBuilder::most_fields, "fields"); continue; }
        if (!names.insert(f.name).second) { diag_.report(Diag::duplicate_field, span(name), f.name); continue; }
        f.default_value.slot = static_cast<std::uint16_t>(fields.size());
        fields.push_back(f);
      }
    }
  }

  TypeId proto_type(std::string_view name, std::vector<FieldDef> fields) {
    NodeType t;
    t.name = scene_.keep(name);
    t.kind = NodeKind::proto;
    t.dialects = 0xff;
    return scene_.add_type(t, std::move(fields));
  }

  void proto(Token keyword) {
    Token name = lex_.next();
    if (!name_like(name)) { expected("a name", name); lex_.seek(name.begin); return; }
    auto proto_name = new_name(name);
    auto fields = interface(true);
    Proto p;
    p.where = span(keyword);
    if (Token t = lex_.peek(); t.kind != Kind::open_brace) { expected("'{'", t); }
    else if (scope_depth_ + build_.depth() >= limits_.depth) {
      diag_.report(Diag::too_deep, span(name), limits_.depth);
      lex_.next();
      skip_to_close(Kind::open_brace, Kind::close_brace);
    } else {
      lex_.next();
      ++scope_depth_;
      build_.open_scope();
      interfaces_.push_back(&fields);
      statements(Kind::close_brace);
      interfaces_.pop_back();
      p.body = build_.close_scope();
      --scope_depth_;
    }
    if (p.body.roots.empty()) diag_.report(Diag::empty_proto, span(name), proto_name);
    p.type = proto_type(proto_name, std::move(fields));
    build_.declare_proto(std::move(p), span(name));
  }

  void externproto(Token keyword) {
    Token name = lex_.next();
    if (!name_like(name)) { expected("a name", name); lex_.seek(name.begin); return; }
    auto fields = interface(false);
    Proto p;
    p.where = span(keyword);
    p.external = true;
    Value urls;
    if (string_list(FieldType::MFString, 0, urls)) p.urls.assign(urls.text_span().begin(), urls.text_span().end());
    p.type = proto_type(new_name(name), std::move(fields));
    build_.declare_proto(std::move(p), span(name));
  }

  /// A field that a Script declares: `field SFInt32 n 3`, `eventIn SFBool go IS start`. Other nodes cannot, but unknown
  /// ones of extensions do.
  void script_declaration(const AccessWord& a, Token keyword) {
    const auto& type = build_.current_type();
    if (type.name != "Script") {
      if (type.kind != NodeKind::unknown) diag_.report(Diag::unknown_field, span(keyword), type.name, text(keyword));
      undeclarable(keyword);
      return;
    }
    FieldDef f{};
    Token name;
    if (!declaration(a.access, false, f, name)) return;
    auto declared = build_.declare(f, span(keyword));
    if (!declared) {  // its value is read and dropped
      Value dropped;
      if (f.has_value()) value(f.type, Value::extra_slot, f.name, f.default_value, dropped);
      return;
    }
    std::uint16_t slot = *declared;
    if (is_clause(f.type, slot) || !f.has_value()) return;
    Value v;
    if (value(f.type, slot, f.name, f.default_value, v)) build_.field(v, span(name));
    else build_.field([&] { Value e = f.default_value; e.slot = slot; return e; }(), span(name));
  }

  /// `field SFInt32 n 3` in a node that cannot declare fields: kept as a field of the name "field SFInt32 n".
  void undeclarable(Token keyword) {
    Access access = find_access(text(keyword))->access;
    Token type = lex_.next(), name = lex_.next();
    FieldType t{};
    find_field_type(text(type), t);
    std::string full = std::string(text(keyword)) + ' ' + std::string(text(type)) + ' ' + std::string(name_of(name));
    Value v;
    if (text(lex_.peek()) == "IS") v = is_value(lex_.next(), t, Value::extra_slot);
    else if (access == Access::in || access == Access::out) v = scene_.make(FieldType::verbatim, Value::extra_slot, std::string_view{});
    else if (!value(t, Value::extra_slot, text(name), empty_value(t), v)) return;
    build_.field(scene_.make_extra(full, v), span(keyword));
  }

  // ---- routes ------------------------------------------------------------------------------------------------------
  void route_statement(Token keyword) {
    std::string_view from, out, to, in;
    if (!route_end(from, out)) return;
    if (Token t = lex_.peek(); text(t) == "TO" || text(t) == "to") lex_.next();
    else return expected("TO", t);
    if (!route_end(to, in)) return;
    build_.route(from, out, to, in, span(keyword));
  }

  /// node.event; blanks around the point occur.
  bool route_end(std::string_view& node, std::string_view& event) {
    Token t = lex_.peek();
    if (t.kind != Kind::word) return expected("a node and its event", t), false;
    lex_.next();
    std::string_view w = name_of(t);
    auto point = w.rfind('.');
    if (point != w.npos && point + 1 < w.size() && point > 0) { node = w.substr(0, point); event = w.substr(point + 1); return true; }
    node = point == w.npos ? w : w.substr(0, point);
    Token e = lex_.peek();
    if (e.kind != Kind::word) return expected("an event", e), false;
    lex_.next();
    event = name_of(e);
    if (point == w.npos) {
      if (!event.starts_with('.')) return expected("'.'", e), false;
      event.remove_prefix(1);
      if (event.empty()) {
        e = lex_.next();
        if (e.kind != Kind::word) return expected("an event", e), false;
        event = name_of(e);
      }
    }
    return true;
  }

  Lexer lex_;
  std::uint32_t base_;
  ParseLimits limits_;
  Scene& scene_;
  Diagnostics& diag_;
  SceneBuilder build_;
  std::vector<double> numbers_;
  std::vector<std::int32_t> integers_;
  std::vector<NodeId> nodes_, misplaced_;
  std::vector<const std::vector<FieldDef>*> interfaces_;  // of the prototypes whose bodies are being read
  std::size_t scope_depth_ = 0, open_lists_ = 0;
  bool unclosed_ = false, open_string_ = false;  // at the end of the text
};

}  // namespace

void parse(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag) {
  Parser(text, base, limits, scene, diag).vrml_scene();
}

}  // namespace wrlkit::vrml

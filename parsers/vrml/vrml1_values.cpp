// Values as VRML 1.0 writes them: enumerations and bit masks, strings without quotes, 0 and 1 as booleans.
#include "parsers/vrml/values.h"

namespace wrlkit::vrml {

bool Values::vrml1_value(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback,
                         Value& out) {
  Token t = lex_.peek();
  if (type == FieldType::SFBool && (text(t) == "0" || text(t) == "1")) {  // both are in order here
    out = scene_.make(type, slot, text(lex_.next()) == "1");
    return true;
  }
  if (type == FieldType::SFEnum || type == FieldType::SFBitMask) return enumeration(type, slot, out);
  if (type == FieldType::MFString) return bare_strings(type, slot, out);
  if (type != FieldType::SFString) return plain_value(type, slot, field, fallback, out);
  std::string_view s;
  if (bare_string(s))
    out = scene_.make(type, slot, s);
  else {
    diag_.report(Diag::bad_value, span(t), describe(t), "SFString");
    return false;
  }
  return true;
}

// A word, or (A | B); blanks may be missing anywhere in it.
bool Values::enumeration(FieldType type, std::uint16_t slot, Value& out) {
  Token first = lex_.peek();
  if (first.kind != Kind::word && first.kind != Kind::string) {
    diag_.report(Diag::bad_value, span(first), describe(first), info(type).name);
    return false;
  }
  std::string all;
  int depth = 0;
  do {
    Token t = lex_.next();
    for (char c : text(t)) {
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      if (c != '(' && c != ')' && !Lexer::separates(c)) all += c;
    }
    if (lex_.peek().kind != Kind::word) break;
  } while (depth > 0 || all.ends_with('|') || text(lex_.peek()).starts_with('|'));
  if (all.empty()) {
    diag_.report(Diag::bad_value, span(first), describe(first), info(type).name);
    return false;
  }
  out = scene_.make(type, slot, utf8(all, span(first)));
  return true;
}

/// A string may stand without quotes, up to a blank.
bool Values::bare_string(std::string_view& out) {
  Token t = lex_.peek();
  if (t.kind != Kind::word) return string_token(out);
  lex_.next();
  out = name_of(t);
  return true;
}

bool Values::bare_strings(FieldType type, std::uint16_t slot, Value& out) {
  std::vector<std::string_view> list;
  std::string_view s;
  Token first = lex_.peek();
  if (take(Kind::open_bracket)) {
    while (bare_string(s)) list.push_back(s);
    if (!take(Kind::close_bracket)) {
      Token t = lex_.peek();
      if (t.kind == Kind::end)
        unclosed(first);
      else {
        expected("a string or ']'", t);
        skip_list();
      }
    }
  } else if (bare_string(s)) {
    list.push_back(s);
  } else {
    diag_.report(Diag::bad_value, span(first), describe(first), "MFString");
    return false;
  }
  out = scene_.make(type, slot, list);
  return true;
}

}  // namespace wrlkit::vrml

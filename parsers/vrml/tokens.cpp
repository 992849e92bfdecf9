#include "parsers/vrml/tokens.h"

#include "base/text/utf8.h"

namespace wrlkit::vrml {

std::string Tokens::describe(Token t) const {
  return t.kind == Kind::end ? "the end of the file" : "'" + std::string(text(t).substr(0, 60)) + "'";
}

void Tokens::expected(std::string_view what, Token found) {
  diag_.report(Diag::syntax, span(found), what, describe(found));
}

bool Tokens::skip_to_close(Kind open, Kind close) {
  for (std::size_t depth = 1;;) {
    Token t = lex_.next();
    if (t.kind == Kind::end) return false;
    if (t.kind == open) ++depth;
    if (t.kind == close && --depth == 0) return true;
  }
}

std::string_view Tokens::utf8(std::string_view s, Span where) {
  if (is_utf8(s)) return s;
  diag_.report(Diag::encoding_repaired, where, "Latin-1");
  return scene_.keep(latin1_to_utf8(s));
}

std::string_view Tokens::new_name(Token t) {
  auto s = text(t);
  if (s.find_first_of("'\\\"") != s.npos || !name_like(t)) diag_.report(Diag::name_repaired, span(t), s);
  return name_of(t);
}

void Tokens::unclosed(Token opened) {
  if (!unclosed_) diag_.report(Diag::unclosed, span(opened), text(opened));
  unclosed_ = true;
}

std::size_t Tokens::skip_list() {
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

bool Tokens::string_token(std::string_view& out) {
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
  if (lex_.closed(t))
    s.remove_suffix(1);
  else
    unclosed_string(t);
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

void Tokens::unclosed_string(Token t) {
  if (!unclosed_) diag_.report(Diag::unclosed_string, span({Kind::string, t.begin, t.begin + 1}));
  unclosed_ = open_string_ = true;
}

std::string Tokens::skip_values() {
  for (;;) {
    Token t = lex_.peek();
    if (t.kind == Kind::open_bracket) {
      lex_.next();
      auto missing = skip_list();
      if (!missing) continue;
      if (Token stop = lex_.peek(); stop.kind == Kind::end)
        unclosed(t);
      else
        expected("']'", stop);
      return '\n' + std::string(missing, ']');  // a comment may come before
    }
    if (!value_like(t)) return {};
    lex_.next();
    if (t.kind == Kind::string && !lex_.closed(t)) unclosed_string(t);
  }
}

}  // namespace wrlkit::vrml

// What every function of the grammar needs of the text: tokens, their places, messages about them, and ways past what
// cannot be read.
#pragma once
#include <string>

#include "base/diagnostics.h"
#include "parsers/vrml/lexer.h"
#include "scenegraph/scene.h"

namespace wrlkit::vrml {

class Tokens {
 protected:
  /// `base` is the offset of text[0] in diag.sources().
  Tokens(std::string_view text, std::uint32_t base, Scene& scene, Diagnostics& diag)
      : lex_(text), base_(base), scene_(scene), diag_(diag) {}

  Span span(Token t) const { return {base_ + t.begin, t.end - t.begin}; }
  std::string_view text(Token t) const { return lex_.text(t); }
  std::string describe(Token t) const;
  bool take(Kind k) {
    const bool is_next = lex_.peek().kind == k;
    if (is_next) lex_.next();
    return is_next;
  }
  /// A name by the grammar's first character, or near to one.
  bool name_like(Token t) const {
    if (t.kind != Kind::word) return false;
    char c = text(t)[0];
    return !(c >= '0' && c <= '9') && c != '+' && c != '-' && c != '.';
  }

  /// A number, a string or a boolean: nothing that a field could be called.
  bool value_like(Token t) const {
    return t.kind == Kind::string ||
           (t.kind == Kind::word && (!name_like(t) || text(t) == "TRUE" || text(t) == "FALSE"));
  }

  // Messages.
  void expected(std::string_view what, Token found);
  /// The same, and the token is read again by the next call.
  void reject(std::string_view what, Token found) {
    expected(what, found);
    lex_.seek(found.begin);
  }
  /// Behind DEF, USE and IS; if not, it is rejected.
  bool is_word(Token name) {
    if (name.kind == Kind::word) return true;
    reject("a name", name);
    return false;
  }
  /// Whether the next token ends what `opened` began: its bracket, which is taken, or the end of the text.
  bool ends(Token next, Kind close, Token opened) {
    if (next.kind == close)
      lex_.next();
    else if (next.kind == Kind::end)
      unclosed(opened);
    return next.kind == close || next.kind == Kind::end;
  }
  /// At the end of the text everything open is unclosed; one message is enough.
  void unclosed(Token opened);
  void unclosed_string(Token);

  // Texts of tokens in UTF-8, which live as long as the scene or the text.
  std::string_view utf8(std::string_view, Span where);
  std::string_view name_of(Token t) { return utf8(text(t), span(t)); }
  /// A name that is being defined: DEF, PROTO, field.
  std::string_view new_name(Token);
  /// A quoted string without its quotes and escapes; a bare word is taken as one. False: there is neither.
  bool string_token(std::string_view& out);

  // Ways past.
  /// Skips to behind the bracket that closes the one just read. False: the text ended first.
  bool skip_to_close(Kind open, Kind close);
  /// From inside a list behind its ']'; a brace that was not opened in it ends it, too. Returns how many ']' are
  /// missing.
  std::size_t skip_list();
  /// Past anything that can be a value: numbers, strings, booleans and lists. What is missing to close it, as text.
  std::string skip_values();

  Lexer lex_;
  std::uint32_t base_;
  Scene& scene_;
  Diagnostics& diag_;
  bool open_string_ = false;  // at the end of the text

 private:
  bool unclosed_ = false;
};

}  // namespace wrlkit::vrml

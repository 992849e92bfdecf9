// Cuts VRML97 text into tokens (ISO/IEC 14772-1, annex A) without copying it and without counting lines. Commas are
// blanks, '#' starts a comment. A word is anything between separators: which words are names and which are numbers is
// the grammar's business, because real files put all kinds of characters into names.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace wrlkit::vrml {

enum class CharClass : std::uint8_t { other, blank, comment, special };

inline constexpr auto char_classes = [] {
  std::array<CharClass, 256> c{};
  // Other control characters occur in damaged files and separate as well.
  for (int i = 0; i <= ' '; ++i) c[i] = CharClass::blank;
  c[','] = CharClass::blank;
  c[0x7f] = CharClass::blank;
  c['#'] = CharClass::comment;
  for (char s : {'{', '}', '[', ']', '"'}) c[static_cast<unsigned char>(s)] = CharClass::special;
  return c;
}();
inline CharClass class_of(char c) { return char_classes[static_cast<unsigned char>(c)]; }

enum class Kind : std::uint8_t { end, word, string, open_brace, close_brace, open_bracket, close_bracket };

struct Token {
  Kind kind = Kind::end;
  std::uint32_t begin = 0, end = 0;  // of a string: with its quotes
};

class Lexer {
 public:
  explicit Lexer(std::string_view text) : begin_(text.data()), p_(begin_), end_(begin_ + text.size()) {}

  Token next() {
    const Token t = peek();
    p_ = behind_;
    return t;
  }
  Token peek() {
    if (at_ != p_) read();
    return token_;
  }
  /// Where a name is expected, behind DEF and USE: a quote in it, as in 12"-PL-3001, begins no string.
  Token next_name();
  /// Whether the token behind that one is an opening brace, without reading it.
  bool brace_follows(Token) const;

  std::uint32_t offset() const { return static_cast<std::uint32_t>(p_ - begin_); }
  void seek(std::uint32_t offset) { p_ = begin_ + offset; }
  std::string_view text(Token t) const { return {begin_ + t.begin, t.end - t.begin}; }
  std::string_view text(std::uint32_t from, std::uint32_t to) const { return {begin_ + from, to - from}; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(end_ - begin_); }
  /// True when a string token was ended by its quote and not by the end of the text.
  bool closed(Token string) const { return string.end - string.begin >= 2 && begin_[string.end - 1] == '"' && closed_; }

  // For the loops over arrays, which read millions of numbers.
  const char* position() const { return p_; }
  const char* limit() const { return end_; }
  void set_position(const char* p) { p_ = p; }
  /// Past blanks, commas and comments.
  void skip_blanks() { p_ = behind_blanks(p_); }

  static bool separates(char c) { return class_of(c) != CharClass::other; }

 private:
  void read();
  const char* behind_blanks(const char*) const;

  const char* begin_;
  const char* p_;
  const char* end_;
  // The token at hand, which the grammar looks at before it takes it.
  const char* at_ = nullptr;  // the position that it is the next one of
  const char* behind_ = nullptr;
  Token token_;
  bool closed_ = true;
};

}  // namespace wrlkit::vrml

#include "parsers/vrml/lexer.h"

#include <array>

namespace wrlkit::vrml {
namespace {

enum Class : std::uint8_t { other, blank, comment, special };

constexpr std::array<Class, 256> make_classes() {
  std::array<Class, 256> c{};
  for (int i = 0; i <= ' '; ++i) c[i] = blank;  // other control characters occur in damaged files and separate as well
  c[','] = blank;
  c[0x7f] = blank;
  c['#'] = comment;
  for (char s : {'{', '}', '[', ']', '"'}) c[static_cast<unsigned char>(s)] = special;
  return c;
}
constexpr auto classes = make_classes();
Class class_of(char c) { return classes[static_cast<unsigned char>(c)]; }

}  // namespace

bool Lexer::separates(char c) { return class_of(c) != other; }

void Lexer::skip_blanks() {
  for (; p_ < end_; ++p_) {
    Class c = class_of(*p_);
    if (c == blank) continue;
    if (c != comment) return;
    while (p_ < end_ && *p_ != '\n' && *p_ != '\r') ++p_;
    if (p_ == end_) return;
  }
}

Token Lexer::next() {
  skip_blanks();
  Token t;
  t.begin = t.end = offset();
  if (p_ == end_) return t;
  char c = *p_++;
  switch (c) {
    case '{':
      t.kind = Kind::open_brace;
      break;
    case '}':
      t.kind = Kind::close_brace;
      break;
    case '[':
      t.kind = Kind::open_bracket;
      break;
    case ']':
      t.kind = Kind::close_bracket;
      break;
    case '"':
      t.kind = Kind::string;
      closed_ = false;
      for (; p_ < end_ && !closed_; ++p_) {
        if (*p_ == '\\' && p_ + 1 < end_)
          ++p_;
        else if (*p_ == '"')
          closed_ = true;
      }
      break;
    default:
      t.kind = Kind::word;
      while (p_ < end_ && class_of(*p_) == other) ++p_;
  }
  t.end = offset();
  return t;
}

}  // namespace wrlkit::vrml

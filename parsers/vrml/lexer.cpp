#include "parsers/vrml/lexer.h"

namespace wrlkit::vrml {

void Lexer::skip_blanks() {
  for (; p_ < end_; ++p_) {
    const CharClass c = class_of(*p_);
    if (c == CharClass::blank) continue;
    if (c != CharClass::comment) return;
    while (p_ < end_ && *p_ != '\n' && *p_ != '\r') ++p_;
    if (p_ == end_) return;
  }
}

const Lexer::Seen& Lexer::read() {
  const char* const at = p_;
  last_seen_ = 1 - last_seen_;
  Seen& seen = seen_[last_seen_];
  seen.token = read_token();
  seen.at = at;
  seen.behind = p_;
  seen.closed = closed_;
  p_ = at;
  return seen;
}

Token Lexer::read_token() {
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
      while (p_ < end_ && class_of(*p_) == CharClass::other) ++p_;
  }
  t.end = offset();
  return t;
}

}  // namespace wrlkit::vrml

#include "parsers/vrml/lexer.h"

namespace wrlkit::vrml {

const char* Lexer::behind_blanks(const char* p) const {
  for (; p < end_; ++p) {
    const CharClass c = class_of(*p);
    if (c == CharClass::blank) continue;
    if (c != CharClass::comment) return p;
    while (p < end_ && *p != '\n' && *p != '\r') ++p;
    if (p == end_) return p;
  }
  return p;
}

Token Lexer::next_name() {
  Token t = next();
  if (t.kind != Kind::word || p_ == end_ || *p_ != '"') return t;
  while (p_ < end_ && (*p_ == '"' || class_of(*p_) == CharClass::other)) ++p_;
  t.end = offset();
  return t;
}

bool Lexer::brace_follows(Token t) const {
  const char* const p = behind_blanks(begin_ + t.end);
  return p < end_ && *p == '{';
}

void Lexer::read() {
  at_ = p_;
  const char* p = behind_blanks(p_);
  token_.begin = static_cast<std::uint32_t>(p - begin_);
  token_.kind = Kind::end;
  if (p < end_) {
    const char c = *p++;
    switch (c) {
      case '{':
        token_.kind = Kind::open_brace;
        break;
      case '}':
        token_.kind = Kind::close_brace;
        break;
      case '[':
        token_.kind = Kind::open_bracket;
        break;
      case ']':
        token_.kind = Kind::close_bracket;
        break;
      case '"':
        token_.kind = Kind::string;
        closed_ = false;
        for (; p < end_ && !closed_; ++p) {
          if (*p == '\\' && p + 1 < end_)
            ++p;
          else if (*p == '"')
            closed_ = true;
        }
        break;
      default:
        token_.kind = Kind::word;
        while (p < end_ && class_of(*p) == CharClass::other) ++p;
    }
  }
  behind_ = p;
  token_.end = static_cast<std::uint32_t>(p - begin_);
}

}  // namespace wrlkit::vrml

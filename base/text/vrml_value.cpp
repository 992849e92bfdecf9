#include "base/text/vrml_value.h"

#include <algorithm>

#include "base/math/digits.h"
#include "base/text/blanks.h"

namespace wrlkit {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_capital(char c) { return (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_'; }
bool is_letter(char c) { return is_capital(c) || (c >= 'a' && c <= 'z'); }

bool is_keyword(std::string_view word) {
  constexpr std::string_view words[] = {"DEF",  "EXPORT", "EXTERNPROTO", "IMPORT", "IS",
                                        "NULL", "PROTO",  "ROUTE",       "TO",     "USE"};
  return std::ranges::find(words, word) != std::end(words);
}

/// With a sign or without, in hexadecimal, too.
bool is_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.starts_with("0x") || word.starts_with("0X")) {
    word.remove_prefix(2);
    return !word.empty() && word.find_first_not_of("0123456789abcdefABCDEF") == word.npos;
  }
  double value = 0;
  return !word.empty() && (is_digit(word.back()) || word.back() == '.') && read_number(word, value);
}

bool is_plain_word(std::string_view word) { return word == "TRUE" || word == "FALSE" || is_number(word); }

bool is_of_vrml1(std::string_view s) {
  if (s.starts_with('(') && s.ends_with(')'))
    return std::ranges::all_of(s.substr(1, s.size() - 2), [](char c) { return is_letter(c) || c == '|' || c == ' '; });
  return std::ranges::all_of(s, is_capital) && !is_digit(s[0]) && !is_keyword(s);
}

class ValueText {
 public:
  explicit ValueText(std::string_view text) : rest_(trim(text)) {}

  bool all_good() {
    while (!rest_.empty())
      if (!one()) return false;
    return depth_ == 0;
  }
  std::size_t count() const { return count_; }
  bool has_strings() const { return has_strings_; }

 private:
  bool one() {
    const char c = rest_[0];
    if (static_cast<unsigned char>(c) <= ' ' || c == ',') return take(1);
    count_ += depth_ == 0 && c != '#' && c != ']';
    if (c == '"') return string();
    if (c == '#') return comment();
    if (c == '[' || c == ']') return bracket();
    return word();
  }

  bool bracket() {
    const bool opens = rest_[0] == '[';
    if (!opens && depth_ == 0) return false;
    depth_ += opens ? 1 : -1;
    return take(1);
  }

  /// One at the very end would swallow what is written behind it.
  bool comment() {
    const auto end = rest_.find_first_of("\r\n");
    return end != rest_.npos && take(end);
  }

  bool string() {
    has_strings_ |= depth_ == 0;
    for (std::size_t i = 1; i < rest_.size(); ++i) {
      if (rest_[i] == '"') return take(i + 1);
      i += rest_[i] == '\\';
    }
    return false;
  }

  bool word() {
    const auto end = std::ranges::find_if(rest_, [](char c) {
      return static_cast<unsigned char>(c) <= ' ' || std::string_view(",[]{}\"#").find(c) != std::string_view::npos;
    });
    const auto length = static_cast<std::size_t>(end - rest_.begin());
    return length > 0 && is_plain_word(rest_.substr(0, length)) && take(length);
  }

  bool take(std::size_t n) {
    rest_.remove_prefix(n);
    return true;
  }

  std::string_view rest_;
  int depth_ = 0;
  std::size_t count_ = 0;
  bool has_strings_ = false;
};

}  // namespace

bool is_vrml97_value(std::string_view s) {
  s = trim(s);
  ValueText values(s);
  return values.all_good() && values.count() > 0;
}

bool is_vrml_value(std::string_view s) {
  s = trim(s);
  return is_vrml97_value(s) || (!s.empty() && is_of_vrml1(s));
}

bool is_bare_list_of_strings(std::string_view vrml_value) {
  ValueText values(vrml_value);
  return values.all_good() && values.has_strings() && values.count() > 1;
}

}  // namespace wrlkit

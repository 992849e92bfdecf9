#include "base/text/json.h"

namespace wrlkit {
namespace {

bool plain(unsigned char c) { return c >= ' ' && c < 0x80 && c != '"' && c != '\\'; }

// Length of the well-formed UTF-8 sequence at the front (Unicode, table 3-7); 0: none.
std::size_t sequence(std::string_view s) {
  auto at = [&](std::size_t i) { return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u; };
  auto tail = [&](std::size_t i) { return (at(i) & 0xc0) == 0x80; };
  unsigned c = at(0);
  if (c >= 0xc2 && c <= 0xdf) return tail(1) ? 2 : 0;
  if (c >= 0xe0 && c <= 0xef)
    return tail(1) && tail(2) && !(c == 0xe0 && at(1) < 0xa0) && !(c == 0xed && at(1) > 0x9f) ? 3 : 0;
  if (c >= 0xf0 && c <= 0xf4)
    return tail(1) && tail(2) && tail(3) && !(c == 0xf0 && at(1) < 0x90) && !(c == 0xf4 && at(1) > 0x8f) ? 4 : 0;
  return 0;
}

void escape(std::string& out, unsigned char c) {
  constexpr char hex[] = "0123456789abcdef";
  switch (c) {
    case '"':
      out += "\\\"";
      return;
    case '\\':
      out += "\\\\";
      return;
    case '\n':
      out += "\\n";
      return;
    case '\r':
      out += "\\r";
      return;
    case '\t':
      out += "\\t";
      return;
    default:
      (out += "\\u00") += hex[c >> 4];
      out += hex[c & 15];
  }
}

}  // namespace

void JsonOut::string(std::string_view s) {
  if (comma_) out_ += ',';
  out_ += '"';
  while (!s.empty()) {
    std::size_t n = 0;
    while (n < s.size() && plain(static_cast<unsigned char>(s[n]))) ++n;
    out_ += s.substr(0, n);
    s.remove_prefix(n);
    if (s.empty()) break;
    auto c = static_cast<unsigned char>(s[0]);
    if (c < 0x80) {
      escape(out_, c);
      n = 1;
    } else if ((n = sequence(s)))
      out_ += s.substr(0, n);
    else {
      out_ += "\xef\xbf\xbd";
      n = 1;
    }
    s.remove_prefix(n);
  }
  out_ += '"';
}

}  // namespace wrlkit

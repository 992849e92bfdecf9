#include "base/text/json.h"

#include "base/text/utf8.h"

namespace wrlkit {
namespace {

bool plain(unsigned char c) { return c >= ' ' && c < 0x80 && c != '"' && c != '\\'; }

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
    } else if ((n = utf8_sequence(s)))
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

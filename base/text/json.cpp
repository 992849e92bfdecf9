#include "base/text/json.h"

#include <bit>
#include <cstring>

#include "base/text/utf8.h"

namespace wrlkit {
namespace {

bool plain(unsigned char c) { return c >= ' ' && c < 0x80 && c != '"' && c != '\\'; }

static_assert(std::endian::native == std::endian::little, "the first character is the lowest byte");

/// How many characters a text begins with that stand for themselves; eight are looked at at once. A byte of
/// `others` is not zero where one is none of them, or where one before it is none.
std::size_t n_plain(std::string_view s) {
  constexpr std::uint64_t ones = 0x0101010101010101u, tops = 0x8080808080808080u;
  std::size_t n = 0;
  for (; n + sizeof(std::uint64_t) <= s.size(); n += sizeof(std::uint64_t)) {
    std::uint64_t bytes;
    std::memcpy(&bytes, s.data() + n, sizeof bytes);
    const auto zeros = [](std::uint64_t x) { return (x - ones) & ~x; };
    const std::uint64_t others =
        (bytes | (bytes - ones * ' ') | zeros(bytes ^ ones * '"') | zeros(bytes ^ ones * '\\')) & tops;
    if (others) return n + static_cast<std::size_t>(std::countr_zero(others)) / 8;
  }
  while (n < s.size() && plain(static_cast<unsigned char>(s[n]))) ++n;
  return n;
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
    std::size_t n = n_plain(s);
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

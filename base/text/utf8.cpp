#include "parsers/vrml/text_encoding.h"

#include <algorithm>
#include <cstdint>

namespace wrlkit::vrml {
namespace {

void append(std::string& out, std::uint32_t c) {
  if (c < 0x80)
    out += static_cast<char>(c);
  else if (c < 0x800)
    (out += static_cast<char>(0xc0 | c >> 6)) += static_cast<char>(0x80 | (c & 0x3f));
  else if (c < 0x10000)
    ((out += static_cast<char>(0xe0 | c >> 12)) += static_cast<char>(0x80 | (c >> 6 & 0x3f))) +=
        static_cast<char>(0x80 | (c & 0x3f));
  else
    (((out += static_cast<char>(0xf0 | c >> 18)) += static_cast<char>(0x80 | (c >> 12 & 0x3f))) +=
     static_cast<char>(0x80 | (c >> 6 & 0x3f))) += static_cast<char>(0x80 | (c & 0x3f));
}

// Length of the well-formed sequence at s[i], 0 when it is none (Unicode, table 3-7).
std::size_t sequence(std::string_view s, std::size_t i) {
  auto b = [&](std::size_t k) { return i + k < s.size() ? static_cast<unsigned char>(s[i + k]) : 0u; };
  auto tail = [&](std::size_t k) { return (b(k) & 0xc0) == 0x80; };
  unsigned c = b(0);
  if (c < 0x80) return 1;
  if (c >= 0xc2 && c <= 0xdf) return tail(1) ? 2 : 0;
  if (c >= 0xe0 && c <= 0xef)
    return tail(1) && tail(2) && !(c == 0xe0 && b(1) < 0xa0) && !(c == 0xed && b(1) > 0x9f) ? 3 : 0;
  if (c >= 0xf0 && c <= 0xf4)
    return tail(1) && tail(2) && tail(3) && !(c == 0xf0 && b(1) < 0x90) && !(c == 0xf4 && b(1) > 0x8f) ? 4 : 0;
  return 0;
}

}  // namespace

bool is_utf8(std::string_view s) {
  if (std::ranges::all_of(s, [](char c) { return static_cast<unsigned char>(c) < 0x80; })) return true;
  for (std::size_t i = 0; i < s.size();) {
    auto n = sequence(s, i);
    if (!n) return false;
    i += n;
  }
  return true;
}

std::string latin1_to_utf8(std::string_view s) {
  std::string out;
  out.reserve(s.size() * 2);
  for (unsigned char c : s) append(out, c);
  return out;
}

std::string utf16_to_utf8(std::string_view s) {
  bool big = s.size() >= 2 && static_cast<unsigned char>(s[0]) == 0xfe;
  auto unit = [&](std::size_t i) -> std::uint32_t {
    auto a = static_cast<unsigned char>(s[i]), b = static_cast<unsigned char>(s[i + 1]);
    return big ? a << 8 | b : b << 8 | a;
  };
  std::string out;
  for (std::size_t i = 2; i + 1 < s.size(); i += 2) {
    std::uint32_t c = unit(i);
    if (c >= 0xd800 && c < 0xdc00 && i + 3 < s.size() && unit(i + 2) >= 0xdc00 && unit(i + 2) < 0xe000) {
      c = 0x10000 + ((c - 0xd800) << 10) + (unit(i + 2) - 0xdc00);
      i += 2;
    } else if (c >= 0xd800 && c < 0xe000)
      c = 0xfffd;
    append(out, c);
  }
  return out;
}

}  // namespace wrlkit::vrml

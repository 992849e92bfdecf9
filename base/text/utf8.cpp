#include "base/text/utf8.h"

#include <algorithm>
#include <cstdint>

namespace wrlkit {

void append_utf8(std::string& out, std::uint32_t c) {
  auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  auto tail = [&](int shift) { put(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xc0 | c >> 6);
  } else if (c < 0x10000) {
    put(0xe0 | c >> 12);
    tail(6);
  } else {
    put(0xf0 | c >> 18);
    tail(12);
    tail(6);
  }
  tail(0);
}

std::size_t utf8_sequence(std::string_view s) {
  auto at = [&](std::size_t i) { return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u; };
  auto tail = [&](std::size_t i) { return (at(i) & 0xc0) == 0x80; };
  const unsigned c = at(0);
  if (c < 0x80) return s.empty() ? 0 : 1;
  if (c >= 0xc2 && c <= 0xdf) return tail(1) ? 2 : 0;
  if (c >= 0xe0 && c <= 0xef)
    return tail(1) && tail(2) && !(c == 0xe0 && at(1) < 0xa0) && !(c == 0xed && at(1) > 0x9f) ? 3 : 0;
  if (c >= 0xf0 && c <= 0xf4)
    return tail(1) && tail(2) && tail(3) && !(c == 0xf0 && at(1) < 0x90) && !(c == 0xf4 && at(1) > 0x8f) ? 4 : 0;
  return 0;
}

bool is_utf8(std::string_view s) {
  if (std::ranges::all_of(s, [](char c) { return static_cast<unsigned char>(c) < 0x80; })) return true;
  while (!s.empty()) {
    const auto n = utf8_sequence(s);
    if (!n) return false;
    s.remove_prefix(n);
  }
  return true;
}

std::string latin1_to_utf8(std::string_view s) {
  std::string out;
  out.reserve(s.size() * 2);
  for (unsigned char c : s) append_utf8(out, c);
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
    append_utf8(out, c);
  }
  return out;
}

}  // namespace wrlkit

#include "base/text/xml_characters.h"

#include <algorithm>
#include <cstdint>

#include "base/text/utf8.h"

namespace wrlkit {
namespace {

struct CodeRange {
  std::uint32_t first, last;
};

// XML 1.0, fourth edition, annex B: the large ranges of BaseChar and Ideographic that the fifth edition has as well.
constexpr CodeRange name_letters[] = {
    {0xc0, 0xd6},     {0xd8, 0xf6},     {0xf8, 0x131},    {0x134, 0x13e},   {0x141, 0x148},   {0x14a, 0x17e},
    {0x180, 0x1c3},   {0x1cd, 0x1f0},   {0x250, 0x2a8},   {0x388, 0x38a},   {0x38e, 0x3a1},   {0x3a3, 0x3ce},
    {0x401, 0x40c},   {0x40e, 0x44f},   {0x451, 0x45c},   {0x45e, 0x481},   {0x531, 0x556},   {0x561, 0x586},
    {0x5d0, 0x5ea},   {0x621, 0x63a},   {0x641, 0x64a},   {0x905, 0x939},   {0xe01, 0xe2e},   {0x10a0, 0x10c5},
    {0x10d0, 0x10f6}, {0x1e00, 0x1e9b}, {0x1ea0, 0x1ef9}, {0x3041, 0x3094}, {0x30a1, 0x30fa}, {0x4e00, 0x9fa5},
    {0xac00, 0xd7a3}};

bool is_name_letter(std::uint32_t c) {
  return std::ranges::any_of(name_letters, [&](CodeRange r) { return c >= r.first && c <= r.last; });
}

/// Of a well-formed sequence.
std::uint32_t code_point(std::string_view sequence) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(sequence[i])); };
  if (sequence.size() == 1) return byte(0);
  std::uint32_t c = byte(0) & (0xffu >> (sequence.size() + 1));
  for (std::size_t i = 1; i < sequence.size(); ++i) c = c << 6 | (byte(i) & 0x3f);
  return c;
}

struct Piece {
  std::size_t size;
  bool held;  // XML can hold it
};

/// The character that a text begins with, or one byte that belongs to none.
Piece first_piece(std::string_view s) {
  const auto c = static_cast<unsigned char>(s[0]);
  if (c < 0x80) return {1, c >= ' ' || c == '\t' || c == '\n' || c == '\r'};
  const auto n = utf8_sequence(s);
  const bool half = !n && c == 0xed && s.size() >= 3 && (s[1] & 0xe0) == 0xa0 && (s[2] & 0xc0) == 0x80;
  if (half) return {3, false};
  if (!n) return {1, false};
  return {n, s.substr(0, n) != "\xef\xbf\xbe" && s.substr(0, n) != "\xef\xbf\xbf"};
}

/// How many bytes a text begins with that XML can hold.
std::size_t n_held(std::string_view s) {
  std::size_t n = 0;
  while (n < s.size()) {
    const auto [size, held] = first_piece(s.substr(n));
    if (!held) break;
    n += size;
  }
  return n;
}

}  // namespace

std::string_view XmlCharacters::only(std::string_view s) {
  std::size_t n = n_held(s);
  if (n == s.size()) return s;
  std::string made;
  while (!s.empty()) {
    made += s.substr(0, n);
    s.remove_prefix(n);
    if (s.empty()) break;
    made += "\xef\xbf\xbd";
    ++n_replaced_;
    s.remove_prefix(first_piece(s).size);
    n = n_held(s);
  }
  made_ = std::move(made);
  return made_;
}

bool is_xml_text(std::string_view s) { return n_held(s) == s.size(); }

bool is_xml_name(std::string_view s) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto follows = [](char c) { return (c >= '0' && c <= '9') || c == '-' || c == '.'; };
  if (s.empty() || follows(s[0])) return false;
  while (!s.empty()) {
    const auto n = utf8_sequence(s);
    if (n == 0 || (n == 1 && !is_letter(s[0]) && !follows(s[0]))) return false;
    if (n > 1 && !is_name_letter(code_point(s.substr(0, n)))) return false;
    s.remove_prefix(n);
  }
  return true;
}

}  // namespace wrlkit

// X bitmaps as X11's XReadBitmapFile reads them ("Xlib - C Language X Interface", 16.9): bits of a row from the lowest
// of its first byte on; those of X10 are in words of 16 bits. What is set is black.
#include <algorithm>
#include <cctype>
#include <charconv>

#include "base/image/decode.h"
#include "base/image/xbm.h"

namespace wrlkit {
namespace {

constexpr std::size_t xbm_preamble = 4096;

bool is_xbm_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// The number behind "#define NAME<ending> "; none: there is no such line.
std::optional<int> xbm_define(std::string_view text, std::string_view ending) {
  constexpr std::string_view define = "#define";
  for (auto at = text.find(define); at != text.npos; at = text.find(define, at + 1)) {
    auto line = text.substr(at + define.size());
    line = line.substr(0, line.find('\n'));
    const auto name = line.find(ending);
    if (name == line.npos) continue;
    line.remove_prefix(name + ending.size());
    while (!line.empty() && is_xbm_space(line.front())) line.remove_prefix(1);
    int value = 0;
    if (std::from_chars(line.data(), line.data() + line.size(), value).ec == std::errc{}) return value;
  }
  return std::nullopt;
}

/// The next number of a list in C, in hexadecimal, octal or decimal digits.
std::optional<std::uint32_t> next_xbm_number(std::string_view& text) {
  while (!text.empty() && (is_xbm_space(text.front()) || text.front() == ',')) text.remove_prefix(1);
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  const int base = hex ? 16 : text.size() > 1 && text.front() == '0' ? 8 : 10;
  if (hex) text.remove_prefix(2);
  std::uint32_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (fault != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// Where the comment of C at the start of a text ends; 0: there is none.
std::size_t xbm_comment(std::string_view text) {
  if (text.starts_with("//")) return std::min(text.find('\n'), text.size());
  if (!text.starts_with("/*")) return 0;
  const auto end = text.find("*/", 2);
  return end == text.npos ? text.size() : end + 2;
}

struct XbmList {
  bool words;  // X10: each number has 16 bits
  std::string_view numbers;
};

/// The list of "static short NAME_bits[] = {" or "static char NAME_bits[] = {". Comments and #define count for nothing,
/// whatever they say. None: there is no such declaration. Linear in the text.
std::optional<XbmList> xbm_list(std::string_view text) {
  bool words = false, named = false, directive = false;
  while (!text.empty()) {
    const char c = text.front();
    auto length = xbm_comment(text);
    if (length == 0) length = std::min(text.find_first_of(" \t\r\n[]={;#/"), text.size());
    const auto token = text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
    if (c == '#') directive = true;
    if (c == '\n') directive = false;
    if (directive || token.starts_with("/")) continue;
    if (c == '{' && named) return XbmList{words, text};
    if (c == ';') words = named = false;
    words |= token == "short";
    named |= token.ends_with("_bits");
  }
  return std::nullopt;
}

}  // namespace

std::optional<XbmSize> xbm_size(std::string_view bytes) {
  const auto text = bytes.substr(0, xbm_preamble);
  const auto begin = text.substr(0, text.find_first_not_of(" \t\r\n") + 2);
  if (!begin.ends_with("#d") && !begin.ends_with("/*")) return std::nullopt;
  const auto width = xbm_define(text, "_width"), height = xbm_define(text, "_height");
  if (!width || !height || *width <= 0 || *height <= 0 || text.find("_bits") == text.npos) return std::nullopt;
  return XbmSize{*width, *height};
}

bool decode_xbm(std::string_view xbm, Image& image, std::string& error) {
  const auto size = xbm_size(xbm);
  error = "its data are damaged";
  const auto list = xbm_list(xbm);
  if (!size || !list) return false;
  error = image_size_fault(size->width, size->height, xbm.size());
  if (!error.empty()) return false;
  error = "its data are damaged";
  const auto width = static_cast<std::size_t>(size->width), height = static_cast<std::size_t>(size->height);
  const std::size_t bits = list->words ? 16 : 8, row = (width + bits - 1) / bits;
  if (row * height > xbm.size()) return false;
  image = {size->width, size->height, 1, std::vector<std::uint8_t>(width * height, 255)};
  auto numbers = list->numbers;
  for (std::size_t i = 0; i < row * height; ++i) {
    const auto number = next_xbm_number(numbers);
    if (!number) return false;
    for (std::size_t bit = 0; bit < bits; ++bit)
      if (const std::size_t x = i % row * bits + bit; x < width && (*number >> bit & 1u) != 0)
        image.pixels[i / row * width + x] = 0;
  }
  error.clear();
  return true;
}

}  // namespace wrlkit

#include "parsers/vrml/number.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "parsers/vrml/lexer.h"

namespace wrlkit::vrml {
namespace {

constexpr double powers_of_ten[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

bool digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

const char* end_of_word(const char* p, const char* end) {
  while (p < end && !Lexer::separates(*p)) ++p;
  return p;
}

bool starts_with_nocase(std::string_view s, std::string_view what) {
  return s.size() >= what.size() &&
         std::equal(what.begin(), what.end(), s.begin(), [](char a, char b) { return a == (b | 0x20); });
}

/// "nan", "NAN0", "nan(ind)" for "nan", but not "nano": that is the name of a field behind a list without brackets.
bool is_odd(std::string_view word, std::string_view what) {
  if (!starts_with_nocase(word, what)) return false;
  word.remove_prefix(what.size());
  return word.starts_with('(') || std::ranges::all_of(word, digit);
}
bool is_infinity(std::string_view word) { return is_odd(word, "inf") || is_odd(word, "infinity"); }
bool is_nan(std::string_view word) {
  return is_odd(word, "nan") || is_odd(word, "qnan") || is_odd(word, "snan") || is_odd(word, "ind");
}

/// At the '#' of "1.#INF", which belongs to the number, although comments begin like that.
bool c_runtime_word(const char* p, const char* end) {
  if (p == end || *p != '#' || p[-1] != '.') return false;
  std::string_view tail(p + 1, static_cast<std::size_t>(end_of_word(p + 1, end) - p - 1));
  return is_infinity(tail) || is_nan(tail);
}

// What CAD programs print most: sign, digits, point, digits, fifteen of them at the most. Both the digits and the power
// of ten are exact doubles then, so one division rounds correctly. If false, fast_float does everything.
bool read_plain(const char*& at, const char* end, double& out) {
  const char* p = at;
  bool negative = *p == '-';
  p += negative;
  std::uint64_t digits = 0;
  const char* first = p;
  while (p < end && digit(*p)) digits = digits * 10 + static_cast<unsigned>(*p++ - '0');
  std::ptrdiff_t n = p - first, fraction = 0;
  if (p < end && *p == '.') {
    const char* point = ++p;
    while (p < end && digit(*p)) digits = digits * 10 + static_cast<unsigned>(*p++ - '0');
    fraction = p - point;
    n += fraction;
  }
  if (n == 0 || n > 15 || (p < end && !Lexer::separates(*p)) || c_runtime_word(p, end)) return false;
  double v = static_cast<double>(digits) / powers_of_ten[fraction];
  out = negative ? -v : v;
  at = p;
  return true;
}

// nan, -nan(ind), 1.#QNAN, inf, -1.#INF00 of C run times, and hexadecimal integers.
NumberResult read_odd(std::string_view word, double& out) {
  bool negative = word.starts_with('-');
  if (negative || word.starts_with('+')) word.remove_prefix(1);
  auto tail = word.substr(word.find('#') + 1);  // all of it when there is none
  if (is_nan(tail)) {
    out = 0;
    return NumberResult::repaired;
  }
  if (is_infinity(tail)) {
    out = (negative ? -1 : 1) * static_cast<double>(std::numeric_limits<float>::max());
    return NumberResult::repaired;
  }
  if (!starts_with_nocase(word, "0x")) return NumberResult::none;
  std::uint64_t v = 0;
  auto r = std::from_chars(word.data() + 2, word.data() + word.size(), v, 16);
  if (r.ec != std::errc{} || r.ptr == word.data() + 2) return NumberResult::none;
  out = (negative ? -1.0 : 1.0) * static_cast<double>(v);
  return r.ptr == word.data() + word.size() ? NumberResult::exact : NumberResult::repaired;
}

}  // namespace

NumberResult read_double(const char*& p, const char* end, double& out) {
  if (p >= end) return NumberResult::none;
  if (read_plain(p, end, out)) return NumberResult::exact;
  const char* q = p + (*p == '+' && p + 1 < end && p[1] != '-');
  auto r = fast_float::from_chars(q, end, out);
  // Words (nan, inf) are not numbers of VRML; fast_float takes them.
  bool word_like = q < end && !digit(*q) && *q != '.' && *q != '-';
  if (r.ptr != q && !word_like && (r.ptr == end || Lexer::separates(*r.ptr)) && !c_runtime_word(r.ptr, end) &&
      std::isfinite(out)) {
    p = r.ptr;
    return NumberResult::exact;
  }
  const char* stop = end_of_word(p, end);
  // "1.#QNAN": the lexer takes the '#' for a comment.
  const char* odd_stop = stop;
  if (stop > p && c_runtime_word(stop, end)) odd_stop = end_of_word(stop + 1, end);
  double odd;
  if (auto result = read_odd({p, static_cast<std::size_t>(odd_stop - p)}, odd); result != NumberResult::none) {
    p = odd_stop;
    out = odd;
    return result;
  }
  if (r.ptr == q || word_like) return NumberResult::none;
  if (!std::isfinite(out)) out = std::copysign(static_cast<double>(std::numeric_limits<float>::max()), out);
  p = stop;  // "1.5abc", "12-": what could be read counts, the rest of the word is dropped
  return NumberResult::repaired;
}

NumberResult read_int32(const char*& p, const char* end, std::int32_t& out) {
  const char* q = p;
  bool negative = q < end && *q == '-';
  q += negative;
  std::uint32_t v = 0;
  const char* first = q;
  while (q < end && digit(*q)) v = v * 10 + static_cast<unsigned>(*q++ - '0');
  if (q > first && q - first <= 9 && (q == end || Lexer::separates(*q))) {
    out = negative ? -static_cast<std::int32_t>(v) : static_cast<std::int32_t>(v);
    p = q;
    return NumberResult::exact;
  }
  const char* word = p;
  double d = 0;
  auto r = read_double(p, end, d);
  if (r == NumberResult::none) return r;
  // Eight digits are the bits of an int32, so that 0xffffffff is -1.
  bool hexadecimal = p - word > 2 && (word[1] == 'x' || word[1] == 'X');
  if (hexadecimal && d > std::numeric_limits<std::int32_t>::max() && d <= std::numeric_limits<std::uint32_t>::max()) {
    out = static_cast<std::int32_t>(static_cast<std::uint32_t>(d));
    return r;
  }
  double clamped = std::clamp(std::trunc(d), -2147483648.0, 2147483647.0);
  out = static_cast<std::int32_t>(clamped);
  return clamped == d ? r : NumberResult::repaired;
}

}  // namespace wrlkit::vrml

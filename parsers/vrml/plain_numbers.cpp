#include "parsers/vrml/plain_numbers.h"

#include <bit>
#include <cstring>

#include "parsers/vrml/lexer.h"
#include "parsers/vrml/number.h"

namespace wrlkit::vrml {
namespace {

constexpr double float_powers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};
constexpr std::uint64_t whole_powers[] = {1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000};
constexpr std::ptrdiff_t read_ahead = 32;  // a sign, eight digits, a point, and sixteen bytes behind it

struct Digits {
  std::uint64_t value;
  unsigned n;
};

static_assert(std::endian::native == std::endian::little, "the first digit is the lowest byte");

/// The digits at p, eight of them at the most, added up by pairs. A byte that is not a digit is one that exceeds 9 once
/// '0' is taken from it; what the sum carries beyond it falls into bytes that do not count.
Digits digits_at(const char* p) {
  std::uint64_t bytes;
  std::memcpy(&bytes, p, sizeof bytes);
  bytes ^= 0x3030303030303030u;
  const std::uint64_t others = (bytes | (bytes + 0x7676767676767676u)) & 0x8080808080808080u;
  const auto n = static_cast<unsigned>(others ? std::countr_zero(others) / 8 : 8);
  if (n == 0) return {0, 0};
  bytes <<= 64 - 8 * n;
  bytes = (bytes * 10 + (bytes >> 8)) & 0x00ff00ff00ff00ffu;
  bytes = (bytes * 100 + (bytes >> 16)) & 0x0000ffff0000ffffu;
  return {(bytes * 10'000 + (bytes >> 32)) & 0xffffffffu, n};
}

bool is_blank(char c) { return class_of(c) == CharClass::blank; }
bool ends_number(char c) { return is_blank(c) || c == ']'; }

/// Both the digits and the power of ten are exact doubles when there are no more than fifteen digits, so that one
/// division rounds correctly.
const char* read_plain(const char* p, double& out) {
  const bool negative = *p == '-';
  p += negative;
  const Digits whole = digits_at(p);
  p += whole.n;
  Digits part{0, 0};
  if (*p == '.') {
    part = digits_at(++p);
    p += part.n;
  }
  const unsigned n = whole.n + part.n;
  if (n == 0 || n > 15 || !ends_number(*p)) return nullptr;
  const double v = static_cast<double>(whole.value * whole_powers[part.n] + part.value) / float_powers[part.n];
  out = std::bit_cast<double>(std::bit_cast<std::uint64_t>(v) ^ std::uint64_t{negative} << 63);
  return p;
}

const char* read_plain(const char* p, std::int32_t& out) {
  const bool negative = *p == '-';
  p += negative;
  const Digits whole = digits_at(p);
  p += whole.n;
  if (whole.n == 0 || !ends_number(*p)) return nullptr;
  const auto v = static_cast<std::int32_t>(whole.value);
  out = negative ? -v : v;
  return p;
}

template <class T>
const char* read_all(const char* p, const char* end, std::vector<T>& to) {
  for (const char* last = end - p > read_ahead ? end - read_ahead : p; p < last;) {
    if (is_blank(*p)) {
      ++p;
      continue;
    }
    T v;
    const char* behind = read_plain(p, v);
    if (!behind) break;
    to.push_back(v);
    p = behind + is_blank(*behind);
  }
  return p;
}

NumberResult read_number(const char*& p, const char* end, double& out) { return read_double(p, end, out); }
NumberResult read_number(const char*& p, const char* end, std::int32_t& out) { return read_int32(p, end, out); }

template <class T>
bool read_list(std::string_view list, const char* limit, std::vector<T>& to) {
  to.clear();
  const char* p = list.data();
  const char* const end = p + list.size();
  for (;;) {
    p = read_plain_numbers(p, limit, to);
    while (p < end && is_blank(*p)) ++p;
    if (p >= end) return p == end;
    T v;
    if (read_number(p, end, v) != NumberResult::exact) return false;
    to.push_back(v);
  }
}

}  // namespace

bool read_plain_list(std::string_view list, const char* end, std::vector<double>& to) {
  return read_list(list, end, to);
}
bool read_plain_list(std::string_view list, const char* end, std::vector<std::int32_t>& to) {
  return read_list(list, end, to);
}

const char* read_plain_numbers(const char* p, const char* end, std::vector<double>& to) { return read_all(p, end, to); }
const char* read_plain_numbers(const char* p, const char* end, std::vector<std::int32_t>& to) {
  return read_all(p, end, to);
}

}  // namespace wrlkit::vrml

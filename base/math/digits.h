// Numbers by their decimal digits.
#pragma once
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>

#include "base/math/shortest.h"

namespace wrlkit {

/// The shortest text that reads back as the same number.
template <class N>
std::string shortest_text(N v) {
  char text[40];
  return {text, write_shortest(text, v)};
}

/// Reads a text that is a number from end to end, without blanks. False otherwise; `v` is undefined then.
template <class N>
bool read_number(std::string_view text, N& v) {
  const char* const end = text.data() + text.size();
  const auto r = std::from_chars(text.data(), end, v);
  return r.ec == std::errc{} && r.ptr == end;
}

/// The double that has the digits of the float: 0.1f is written as 0.1 and not as 0.10000000149011612. Read back it is
/// the same float.
inline double decimal(float f) {
  if (f == std::trunc(f)) return f;
  char text[32];
  double d = f;
  std::from_chars(text, std::to_chars(text, text + sizeof text, f).ptr, d);
  return d;
}

/// The number with N significant digits. Never -0.
inline double to_digits(double v, int n) {
  char text[40];
  const char* end = std::to_chars(text, text + sizeof text, v, std::chars_format::general, n).ptr;
  std::from_chars(text, end, v);
  return v + 0.0;
}

/// With 15 digits a number is short again after some arithmetic: 0.1 + 0.2 becomes 0.3.
inline double to_15_digits(double v) { return to_digits(v, 15); }

/// The same for every number of an array.
template <class Numbers>
Numbers all_to_15_digits(Numbers numbers) {
  for (double& v : numbers) v = to_15_digits(v);
  return numbers;
}

}  // namespace wrlkit

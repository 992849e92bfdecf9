#pragma once
#include <charconv>
#include <cstddef>

namespace wrlkit {

/// The number with 15 significant digits, which is short again after some arithmetic: 0.1 + 0.2 becomes 0.3. Never -0.
inline double to_15_digits(double v) {
  char text[40];
  const char* end = std::to_chars(text, text + sizeof text, v, std::chars_format::general, 15).ptr;
  std::from_chars(text, end, v);
  return v + 0.0;
}

/// Of every number of an array.
template <class Numbers>
Numbers all_to_15_digits(Numbers numbers) {
  for (double& v : numbers) v = to_15_digits(v);
  return numbers;
}

}  // namespace wrlkit

// The case of ASCII letters, whatever the locale.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>

namespace wrlkit {

constexpr char to_lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// A copy in lower case. O(length).
inline std::string lower_case(std::string_view s) {
  std::string out(s);
  std::ranges::transform(out, out.begin(), to_lower);
  return out;
}

inline bool equal_ignoring_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, {}, to_lower, to_lower);
}

inline bool starts_with_ignoring_case(std::string_view s, std::string_view beginning) {
  return equal_ignoring_case(s.substr(0, beginning.size()), beginning);
}

inline bool ends_with_ignoring_case(std::string_view s, std::string_view end) {
  return s.size() >= end.size() && equal_ignoring_case(s.substr(s.size() - end.size()), end);
}

}  // namespace wrlkit

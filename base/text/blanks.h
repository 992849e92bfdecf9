// Blanks around words.
#pragma once
#include <string_view>

namespace wrlkit {

/// Without blanks, line breaks and other control characters at both ends.
inline std::string_view trim(std::string_view s) {
  while (!s.empty() && static_cast<unsigned char>(s.front()) <= ' ') s.remove_prefix(1);
  while (!s.empty() && static_cast<unsigned char>(s.back()) <= ' ') s.remove_suffix(1);
  return s;
}

}  // namespace wrlkit

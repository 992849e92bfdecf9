// An SFBitMask of VRML 1.0 is the text of its keywords, "SIDES|BOTTOM", without blanks and parentheses.
#pragma once
#include <algorithm>
#include <string_view>

namespace wrlkit {

/// Calls f(std::string_view) for each keyword.
template <class F>
void for_each_bit(std::string_view mask, F&& f) {
  while (!mask.empty()) {
    auto bar = std::min(mask.find('|'), mask.size());
    if (bar) f(mask.substr(0, bar));
    mask.remove_prefix(std::min(bar + 1, mask.size()));
  }
}

/// Whether a mask has that keyword, or ALL.
inline bool has_bit(std::string_view mask, std::string_view word) {
  bool found = false;
  for_each_bit(mask, [&](std::string_view w) { found |= w == word || w == "ALL"; });
  return found;
}

}  // namespace wrlkit

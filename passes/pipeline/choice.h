// An option that is one of a few values, each with a name.
#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace wrlkit {

/// Text as a template argument.
template <std::size_t N>
struct NameText {
  char text[N];
  consteval NameText(const char (&s)[N]) { std::copy_n(s, N, text); }
  constexpr std::string_view view() const { return {text, N - 1}; }
};

/// The values of Enum from 0 on, by these names: Choice<Axis, "x", "y", "z">. Its type, as help shows it, is
/// "x, y or z".
template <class Enum, NameText... names>
struct Choice {
  static constexpr std::array<std::string_view, sizeof...(names)> all{names.view()...};
  static inline const std::string type = [] {
    std::string out(all[0]);
    for (std::size_t i = 1; i < all.size(); ++i) out += (i + 1 < all.size() ? ", " : " or ") + std::string(all[i]);
    return out;
  }();

  Enum value{};

  operator Enum() const { return value; }
  bool read(std::string_view text) {
    const auto found = std::ranges::find(all, text);
    if (found == all.end()) return false;
    value = static_cast<Enum>(found - all.begin());
    return true;
  }
  std::string print() const { return std::string(all[static_cast<std::size_t>(value)]); }
};

}  // namespace wrlkit

// The keywords for the access to a field.
#pragma once
#include <algorithm>
#include <array>
#include <optional>

#include "scenegraph/node_table.h"

namespace wrlkit {

namespace access_words {
inline constexpr std::array<std::string_view, 4> vrml{"field", "exposedField", "eventIn", "eventOut"};
inline constexpr std::array<std::string_view, 4> x3d{"initializeOnly", "inputOutput", "inputOnly", "outputOnly"};
}  // namespace access_words

inline std::string_view access_word(Access a, Dialect d = Dialect::vrml97) {
  return (d == Dialect::x3d ? access_words::x3d : access_words::vrml)[static_cast<std::size_t>(a)];
}

/// The keywords of VRML, or of X3D, which occur in VRML files that were converted half-way.
inline std::optional<Access> find_access(std::string_view word) {
  for (const auto& words : {access_words::vrml, access_words::x3d})
    if (const auto at = std::ranges::find(words, word); at != words.end())
      return static_cast<Access>(at - words.begin());
  return std::nullopt;
}

}  // namespace wrlkit

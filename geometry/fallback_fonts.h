// Fonts for letters that neither the DejaVu nor the Liberation fonts have, and the packages of Debian they are in.
#pragma once
#include <array>
#include <cstdint>

namespace wrlkit {

struct FallbackFonts {
  char32_t first, last;              // letters
  std::array<const char*, 4> files;  // in the order of preference; null: no more
  const char* package;
};

/// Null where none is known.
const FallbackFonts* fallback_fonts(char32_t);

}  // namespace wrlkit

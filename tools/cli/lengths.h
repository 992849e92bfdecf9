// Lengths with units, on the command line.
#pragma once
#include "passes/pipeline/length_option.h"

namespace wrlkit {

/// "2mm", "0.5in", "0.002": a length in metres. 0 when it is none.
inline double length_of(const std::string& text) {
  LengthOption length;
  return length.read(text) ? length.metres : 0;
}

}  // namespace wrlkit

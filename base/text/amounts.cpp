#include "base/text/amounts.h"

#include <cstdlib>

#include "base/text/letter_case.h"

namespace wrlkit {

namespace {

/// What stands behind the number, in lower case and without blanks.
std::string unit_behind(const char* number) {
  std::string out;
  for (; *number; ++number)
    if (*number != ' ') out += to_lower(*number);
  return out;
}

}  // namespace

std::uint64_t size_of(const std::string& s) {
  char* end = nullptr;
  const double v = std::strtod(s.c_str(), &end);
  std::string unit = unit_behind(end);
  if (unit.ends_with('b')) unit.pop_back();
  if (unit.size() == 2 && unit.ends_with('i')) unit.pop_back();
  const double factor = unit == "t"    ? 0x1p40
                        : unit == "g"  ? 0x1p30
                        : unit == "m"  ? 0x1p20
                        : unit == "k"  ? 0x1p10
                        : unit.empty() ? 1
                                       : 0;
  const double bytes = v * factor;
  return bytes >= 1 && bytes < 0x1p63 ? static_cast<std::uint64_t>(bytes) : 0;
}

double seconds_of(const std::string& text) {
  char* end = nullptr;
  const double v = std::strtod(text.c_str(), &end);
  const std::string unit = unit_behind(end);
  const double factor = unit == "h" ? 3600 : unit == "m" || unit == "min" ? 60 : unit == "s" || unit.empty() ? 1 : 0;
  return v > 0 ? v * factor : 0;
}

}  // namespace wrlkit

#include "tools/cli/amounts.h"

#include <cstdlib>

namespace wrlkit {

std::uint64_t size_of(const std::string& s) {
  char* end = nullptr;
  double v = std::strtod(s.c_str(), &end);
  std::string unit = end;
  if (!unit.empty() && (unit.back() == 'B' || unit.back() == 'b')) unit.pop_back();
  if (unit.ends_with('i')) unit.pop_back();
  double factor = unit == "G" || unit == "g"   ? 1 << 30
                  : unit == "M" || unit == "m" ? 1 << 20
                  : unit == "K" || unit == "k" ? 1 << 10
                  : unit.empty()               ? 1
                                               : 0;
  return v > 0 ? static_cast<std::uint64_t>(v * factor) : 0;
}

double seconds_of(const std::string& text) {
  char* end = nullptr;
  const double v = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const double factor = unit == "h" ? 3600 : unit == "m" || unit == "min" ? 60 : unit == "s" || unit.empty() ? 1 : 0;
  return v > 0 ? v * factor : 0;
}

}  // namespace wrlkit

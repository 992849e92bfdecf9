// Units of length, as options and files name them.
#pragma once
#include <optional>
#include <string_view>

namespace wrlkit {

/// Metres in one m, cm, mm, in or ft; none of another word.
constexpr std::optional<double> metres_in(std::string_view unit) {
  if (unit == "m") return 1;
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  if (unit == "in") return 0.0254;
  if (unit == "ft") return 0.3048;
  return std::nullopt;
}

}  // namespace wrlkit

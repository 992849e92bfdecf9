// A time as an option of a pass: 60s, 10m.
#pragma once
#include <cmath>
#include <string>
#include <string_view>

#include "base/math/digits.h"
#include "base/text/amounts.h"

namespace wrlkit {

struct TimeOption {
  static constexpr std::string_view type = "time", examples = "60s, 10m";
  double seconds = 0;

  bool read(std::string_view text) {
    seconds = text == "0" ? 0 : seconds_of(std::string(text));
    return text == "0" || (seconds > 0 && std::isfinite(seconds));
  }
  std::string print() const { return shortest_text(seconds) + (seconds > 0 ? "s" : ""); }
};

}  // namespace wrlkit

// A length as an option of a pass: 20mm, 2cm, 0.02.
#pragma once
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "base/math/digits.h"
#include "base/text/length_unit.h"

namespace wrlkit {

struct LengthOption {
  static constexpr std::string_view type = "length", examples = length_examples;
  double metres = 0;

  bool read(std::string_view text) {
    double v = 0;
    auto r = std::from_chars(text.data(), text.data() + text.size(), v);
    std::string_view unit(r.ptr, static_cast<std::size_t>(text.data() + text.size() - r.ptr));
    while (unit.starts_with(' ')) unit.remove_prefix(1);
    const auto scale = metres_in(unit.empty() ? "m" : unit);
    if (r.ec != std::errc{} || !scale || !(v >= 0) || !std::isfinite(v)) return false;
    metres = v * *scale;
    return true;
  }
  /// In metres.
  std::string print() const { return shortest_text(metres); }
};

}  // namespace wrlkit

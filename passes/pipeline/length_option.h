// A length as an option of a pass: 20mm, 2cm, 0.02.
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace wrlkit {

struct LengthOption {
  static constexpr std::string_view type = "length";
  double metres = 0;

  bool read(std::string_view text) {
    constexpr struct {
      std::string_view name;
      double metres;
    } units[] = {{"", 1}, {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
    double v = 0;
    auto r = std::from_chars(text.data(), text.data() + text.size(), v);
    const std::string_view unit(r.ptr, static_cast<std::size_t>(text.data() + text.size() - r.ptr));
    auto u = std::ranges::find(units, unit, [](const auto& x) { return x.name; });
    if (r.ec != std::errc{} || u == std::end(units) || !(v >= 0) || !std::isfinite(v)) return false;
    metres = v * u->metres;
    return true;
  }
  /// In metres.
  std::string print() const {
    char text[40];
    return {text, std::to_chars(text, text + sizeof text, metres).ptr};
  }
};

}  // namespace wrlkit

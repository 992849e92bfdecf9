// Lengths with units, on the command line.
#pragma once
#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

namespace wrlkit {

/// "2mm", "0.5in", "0.002": a length in metres. 0 when it is none.
inline double length_of(const std::string& text) {
  constexpr struct { std::string_view name; double metres; } units[] = {{"", 1}, {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  double v = 0;
  auto r = std::from_chars(text.data(), text.data() + text.size(), v);
  const std::string_view unit(r.ptr, static_cast<std::size_t>(text.data() + text.size() - r.ptr));
  auto u = std::ranges::find(units, unit, [](const auto& x) { return x.name; });
  return r.ec == std::errc{} && u != std::end(units) ? v * u->metres : 0;
}

}  // namespace wrlkit

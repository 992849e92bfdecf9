#include "base/text/length_unit.h"

#include "base/text/letter_case.h"

namespace wrlkit {

std::optional<double> metres_in(std::string_view unit) {
  struct Row {
    std::string_view name;
    double metres;
  };
  constexpr Row rows[] = {{"m", 1},         {"metre", 1},          {"metres", 1},         {"meter", 1},
                          {"meters", 1},    {"cm", 0.01},          {"centimetre", 0.01},  {"centimeter", 0.01},
                          {"mm", 0.001},    {"millimetre", 0.001}, {"millimeter", 0.001}, {"in", 0.0254},
                          {"inch", 0.0254}, {"inches", 0.0254},    {"\"", 0.0254},        {"ft", 0.3048},
                          {"foot", 0.3048}, {"feet", 0.3048},      {"'", 0.3048}};
  for (const Row& r : rows)
    if (equal_ignoring_case(unit, r.name)) return r.metres;
  return std::nullopt;
}

}  // namespace wrlkit

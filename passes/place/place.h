// Metres, and Y upwards, for a scene that was made in others.
#pragma once
#include "base/choice.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

enum class Unit : std::uint8_t { m, cm, mm, in, ft };
template <>
inline constexpr auto choices<Unit> = choice_row({{"m"}, {"cm"}, {"mm"}, {"in"}, {"ft"}});

enum class UpAxis : std::uint8_t { y, z, x };
template <>
inline constexpr auto choices<UpAxis> = choice_row({{"y"}, {"z"}, {"x"}});

struct PlaceOptions {
  static constexpr std::string_view doc =
      R"(
Puts the scene below a Transform that scales it to metres and turns it so that Y points up.

    before   Shape { geometry Box { size 250 250 40 } }     # millimetres, Z up
    after    Transform { rotation 1 0 0 -1.5708 scale 0.001 0.001 0.001 children Shape { ... } }

`--unit` and `--up` put this pass first in every pipeline. Cost: constant.)";

  Unit unit = Unit::m;
  UpAxis up = UpAxis::y;

  void fields(auto&& f) {
    f("unit", unit, "unit of length of the file");
    f("up", up, "axis of the file that points up");
  }
};
Outcome place(Scene&, const PlaceOptions&, PassContext&);

}  // namespace wrlkit

// How the light of PointLights and SpotLights falls with distance.
#pragma once
#include "base/choice.h"

namespace wrlkit {

/// as_written: by their attenuation, and to their radius. inverse_square: as light does, and as far as it goes; a lamp
/// is as strong as it was written at its reach (light/lamp_reach.h).
enum class LampFall : std::uint8_t { as_written, inverse_square };
template <>
inline constexpr auto choices<LampFall> = choice_row(
    {{"as-written", "by attenuation and radius"},
     {"inverse-square", "by the square of the distance; as bright as written at the distance of what they light"}});

}  // namespace wrlkit

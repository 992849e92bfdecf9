// How far a lamp shines, for lamps that fall by the square of the distance.
#pragma once
#include <optional>

#include "light/render/light.h"

namespace wrlkit::light {

class LightWorld;

/// The root mean square of the distances to what a PointLight or SpotLight shines at, over all directions to which it
/// does, in units of the light's frame. Distances beyond its radius count as the radius, directions in which nothing
/// opaque stands not at all; none when there is nothing in any. With it a lamp of constant attenuation sends out as
/// much light by the inverse square as it did to places within its radius. 256 rays; the same for the same world.
std::optional<double> lamp_reach(const drawing::Light& lamp, const LightWorld& world);

}  // namespace wrlkit::light

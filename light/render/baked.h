// Surfaces whose light was baked: they are not lit again. What they send is in linear numbers, as light is.
//
// A lightmap alone says how much light arrives, not from where, so a surface shows albedo times light and nothing
// shines. With the mean direction v of the light (0: it comes from all sides alike, length 1: from one), radiance is
// taken as linear over the sphere of directions, proportional to 1 + 3 v.w. Then a surface of normal n gets 1 + 2 v.n,
// relative to any other: the texel, which holds for the normal of the face, is corrected for the interpolated normal,
// and for each of the three colours by itself. The part |v| of the light shines as one lamp in direction v: what makes
// highlights that move with the viewer.
#pragma once
#include <array>
#include <optional>

#include "light/render/light.h"
#include "light/render/surface.h"

namespace wrlkit::drawing {

/// Baked light at one place.
struct LightSample {
  V3 light;                                    // what a white face reflects, linear
  std::optional<std::array<V3, 3>> direction;  // X, Y and Z of v, each for red, green and blue
};

/// `detail` is in pixels of the lightmap.
LightSample sample_light(const BakedLight& baked, const std::array<double, 2>& place, double detail);

/// The colour that is seen, display-referred. `base` is the surface's own colour there, `face` the unit normal of the
/// triangle on the side of the viewer.
V3 baked_color(const Surface& surface, const V3& base, const LightSample& sample, const LitPoint& at, const V3& face);

}  // namespace wrlkit::drawing

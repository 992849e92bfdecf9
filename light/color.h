// From the colours of the display, which VRML writes, to light, in which sums are taken: IEC 61966-2-1 (sRGB).
#pragma once
#include "base/image/srgb.h"
#include "light/render/linear.h"

namespace wrlkit::light {

using drawing::V3;

/// Goes on beyond 1 by the same formula: lights may be brighter than white.
inline double linear(double display) { return display > 0 ? srgb_to_linear(display) : 0; }
inline V3 linear(const V3& display) { return {linear(display.x), linear(display.y), linear(display.z)}; }

/// By how much a colour counts where one number has to do.
inline double mean(const V3& c) { return (c.x + c.y + c.z) / 3; }

}  // namespace wrlkit::light

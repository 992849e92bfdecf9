// What a triangle of even radiance gives when nothing stands between: Lambert's formula (1760), in closed form.
#pragma once
#include "light/flux.h"

namespace wrlkit::light {

/// Irradiance at a receiver by radiance 1 of a triangle; of what lies behind the receiver's face or below the horizon
/// of its normal nothing counts. Corners are relative to where the receiver's rays start. Exact but for rounding.
double irradiance_of(const V3 (&corner)[3], const Receiver& at);

}  // namespace wrlkit::light

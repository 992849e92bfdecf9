// A pipe turned by one of its segments is the same pipe: of all the frames that show the same faces, one for each form.
#pragma once
#include "geometry/forms/form.h"

namespace wrlkit {

/// Turns the frame of a form, within what leaves its faces where they are, as near to no rotation as can be, so that
/// parts that stand alike have equal frames. Sizes of boxes, points of profiles
/// and caps change places with it. Linear in the points of a profile.
void turn_upright(Form& form);

}  // namespace wrlkit

// Light that came through a wall, where nothing but surfaces that shine gives any.
#pragma once
#include "light/integrator.h"

namespace wrlkit::bake {

/// Whether a point that closed surfaces hide gets light of an emitter that they do not hide: in a closed thing there is
/// only light of what is in it, or lies in its wall. Of the emitters those four that would give most are looked at.
/// O(emitters, some thousand at the most).
bool is_lit_from_outside(const light::LightWorld& world, const light::Point& p);

}  // namespace wrlkit::bake

// A ParticleSystem (ISO/IEC 19775-1, clause 40) as it stands at one moment.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit::x3d {

/// Each ParticleSystem that is at work becomes a Shape of its particles, or a Group of copies of its geometry, one
/// second after it began (at half of its particles' life where that is shorter), the same in each run. What keeps
/// particles in or out (BoundedPhysicsModel) and turbulence are left out. O(particles, triangles of emitters).
bool lower_particles(Scene&, PassContext&);

}  // namespace wrlkit::x3d

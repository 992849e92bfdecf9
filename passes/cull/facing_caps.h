// The ends of pipes that stand against each other: the discs are not visible between them.
#pragma once
#include <cstdint>
#include <functional>

#include "scenegraph/scene.h"

namespace wrlkit {

struct DroppedCaps {
  std::size_t caps = 0;
  std::uint64_t triangles = 0;
};

/// Opens forms (geometry/forms/form.h) with segments of their own where another one closes them: two round caps face
/// each other around one middle, within a fifth of a millimetre. Of equal caps both go, of others the one within the
/// other. Only forms that are closed all around, so that nothing can be seen from within; only what `may_change`, and
/// only where it holds for all places of a Shape. n log n in the places of forms.
DroppedCaps drop_facing_caps(Scene& scene, const std::function<bool(NodeId shape)>& may_change);

}  // namespace wrlkit

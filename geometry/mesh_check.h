// Invariants of a Mesh.
#pragma once
#include <string>

#include "geometry/mesh.h"

namespace wrlkit {

/// What is wrong with a mesh: an index out of range, faces out of order, streams of different lengths; empty: nothing.
/// O(corners).
std::string breach_of(const Mesh&);

}  // namespace wrlkit

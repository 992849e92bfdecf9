// Faces that a grid would make flat. Most are slivers whose place their neighbours take; a stroke of a letter or a thin
// strip that vanishes has left a hole that is as large as it was.
#pragma once
#include <cstdint>
#include <span>

namespace wrlkit::gltf {

/// Is there a triangle that has no area any more when its points are rounded to multiples of `step`, and from which no
/// other one is within `tolerance` then? Triangles that are flat to begin with do not count; of very many that vanish
/// and have no neighbours some are looked at. Linear.
bool loses_faces(std::span<const float> xyz, std::span<const std::uint32_t> triangles, double step, double tolerance);

}  // namespace wrlkit::gltf

// The first level of a LOD is the child; the others hang on it by MSFT_lod, whose screen coverage is that of the
// level's bounding sphere at the distances of `range`, seen with VRML's standard field of view.
#pragma once
#include "writers/gltf/document/document.h"

namespace wrlkit::gltf {

/// `levels`: nodes, at least one. `radius`: of the first, `scale`: mean length in the world of one of the LOD's frame.
void make_levels(Document&, std::span<const std::uint32_t> levels, std::span<const double> range, double radius,
                 double scale);

}  // namespace wrlkit::gltf

// What one tile shows, as a .glb.
#pragma once
#include <span>

#include "convert/tiles/looks.h"
#include "convert/tiles/piece.h"
#include "writers/gltf/gltf.h"

namespace wrlkit::tiles {

struct ContentBudget {
  std::size_t draws;    // above it, looks that differ in colour alone become one, with a colour at each vertex
  std::uint64_t bytes;  // above it, pictures are made smaller, down to 32 pixels
};

/// Writes pieces as one mesh for each look, around `origin`; their names are rows of a property table that feature ids
/// lead to (EXT_mesh_features, EXT_structural_metadata). False, reported, when it cannot be written. Linear in the
/// corners, with two copies of them in memory; written again for each size of pictures that is still too large.
bool write_content(std::span<const Piece> pieces, const Vec3& origin, const Looks& looks, const GltfOptions& options,
                   const ContentBudget& budget, Resources& pictures, const std::string& path, Diagnostics& diag,
                   GltfSummary& summary);

}  // namespace wrlkit::tiles

// Which parts of a scene can be seen at all, by rays from points on them.
#pragma once
#include <span>
#include <vector>

#include "base/diagnostics.h"
#include "light/render/mesh_pool.h"
#include "light/render/stage.h"

namespace wrlkit {

struct VisibilityOptions {
  bool walkways = true;
  int rays = 256;
  std::uint64_t seed = 1;
  std::span<const char> clear;   // by use: nothing hides behind it
  std::span<const char> wanted;  // by use: others are not asked for
};

/// By use: 1 if it is wanted, has triangles, and all its rays ended at something. The rays of a use go two by two from
/// points that are even by area: one anywhere, one to one of the `viewpoints` or to a visitor's eye, 1.6 m above a face
/// that looks up (Y) and has 1.8 m of air above it. Each number is a hash of (seed, use, ray), so threads do not
/// matter.
std::vector<char> hidden_uses(const drawing::Stage& stage, const drawing::MeshPool& pool,
                              std::span<const std::uint32_t> mesh_of, std::span<const drawing::V3> viewpoints,
                              const VisibilityOptions& options, Diagnostics& diag);

}  // namespace wrlkit

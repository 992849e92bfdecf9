// What a pass is: a free function over a scene, or over one mesh, with an options aggregate that describes itself.
//
//   struct PruneOptions { bool empty_groups = true; void fields(auto&& f) { f("empty-groups", empty_groups, "..."); }
//   }; Outcome prune(Scene&, const PruneOptions&, PassContext&);
//
// A mesh pass sees one geometry at a time and nothing of its neighbours, so the pipeline runs several of them on a
// geometry while it is in the cache.
#pragma once
#include <utility>

#include "base/task.h"
#include "geometry/mesh_job.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"
#include "scenegraph/verify.h"

namespace wrlkit {

enum class Outcome : std::uint8_t { unchanged, changed, failed };

/// What a pass is given besides the scene and its options.
struct PassContext : Task {
  PassContext(Diagnostics& diag, Statistics& stats, Resources* resources = nullptr, Monitor* monitor = nullptr,
              std::stop_token stop = {})
      : Task{diag, stats, monitor, std::move(stop)}, resources(resources) {}

  Resources* resources;  // none: nothing outside the scene can be had
};

}  // namespace wrlkit

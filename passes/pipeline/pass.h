// What a pass is: a free function over a scene, or over one mesh, with an options aggregate that describes itself, the
// pass and what it counts.
//
//   struct JoinOptions {
//     static constexpr std::string_view doc = "One Shape of many that look the same ...";
//     static constexpr StatisticInfo statistics[] = {{"join.shapes", "how many fewer there are"}};
//     bool named = false;
//     void fields(auto&& f) { f("named", named, "also what has a DEF name"); }
//   };
//   Outcome join(Scene&, const JoinOptions&, PassContext&);
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

/// A count of a pass, by its whole name: "weld.joined-points".
struct StatisticInfo {
  std::string_view name, help;
};

/// What a pass is given in addition to the scene and its options.
struct PassContext : Task {
  PassContext(Diagnostics& diag, Statistics& stats, Resources* resources = nullptr, Monitor* monitor = nullptr,
              std::stop_token stop = {})
      : Task{diag, stats, monitor, std::move(stop)}, resources(resources) {}

  Resources* resources;  // none: nothing outside the scene can be read
};

}  // namespace wrlkit

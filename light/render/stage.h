// What is drawn where: the transformation hierarchy unrolled, one entry for each way to a Shape, a light or a
// Viewpoint. The graph may share nodes so that it has far more ways than nodes (forty groups, each holding the next one
// twice), so the walk has a budget.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "light/render/linear.h"
#include "scenegraph/places/ways.h"

namespace wrlkit::drawing {

/// A Shape on its way to the picture.
struct Use {
  NodeId geometry, appearance, shape;
  std::uint32_t frame;   // into Stage::frames
  std::uint32_t lights;  // into Stage::scopes
  std::uint32_t name;    // into Stage::names
};

/// The named nodes on the way to a Shape, and its own name, are a chain up to names[0], which is no node.
struct NameStep {
  NodeId node;
  std::uint32_t parent = 0;
};

/// A node and its frame.
struct Placed {
  NodeId node;
  std::uint32_t frame = 0;
};

/// A DirectionalLight lights what is below its parent. The lights of a Shape are a chain: its scope, the scope's parent
/// and so on to scope 0, which has no light.
struct LightScope {
  std::uint32_t parent = 0, depth = 0;
  Placed light;
};

/// Where the viewer is: Billboards turn there.
struct Pose {
  V3 eye, up{0, 1, 0};
};

struct Stage {
  std::vector<Affine> frames{Affine{}};
  std::vector<Use> uses;
  std::vector<LightScope> scopes{LightScope{}};
  std::vector<NameStep> names{NameStep{}};
  std::vector<Placed> lights;  // PointLights and SpotLights, which light all the world within their radius
  std::vector<Placed> viewpoints;
  std::optional<Placed> background, fog, navigation;  // the first of each kind is the one that is bound (4.6.10)
  bool billboards = false;                            // some frames depend on the viewer
};

/// How many visits and Shapes are allowed beyond the nodes of the scene: one without USE is always drawn whole.
struct StageLimits {
  std::size_t visits = most_visits;
  std::size_t shapes = 1'000'000;
  std::uint32_t uses = 100'000;    // of one node; a scene that doubles itself forty times shows its other things, too
  std::size_t lights = 1000;       // PointLights and SpotLights
  std::uint32_t scope_depth = 64;  // DirectionalLights on one Shape
};

/// Which level of a LOD in `frame` is shown, from 0; beyond its last level it is that one.
using LevelOf = std::function<std::size_t(NodeId lod, const Affine& frame)>;

struct StageOptions {
  std::optional<Pose> viewer{};  // Billboards turn there; none: they stand as they are
  LevelOf level_of{};            // none: the first
  StageLimits limits{};
};

/// Walks the scene in the order of the file. A second walk with another viewer, but the same levels, gives the same
/// entries in other frames.
Stage set_stage(const Scene& scene, Diagnostics& diag, const StageOptions& options = {});

/// The DEF names from the root to a Shape, with '/' between them.
std::string full_name(const Scene& scene, const Stage& stage, const Use& use);

}  // namespace wrlkit::drawing

// The effect of a pass that shares, merges or removes: the statistics of the world before and after it.
#pragma once
#include <string_view>

#include "passes/pipeline/pass.h"

namespace wrlkit {

struct SceneFigures {
  std::uint64_t draws = 0;   // Shapes with geometry as they are shown, each way to one of them
  std::uint64_t nodes = 0;   // of the world, each once
  std::uint64_t meshes = 0;  // geometry nodes that are drawn, each once
};

/// O(nodes and places).
SceneFigures figures_of(const Scene& scene);

/// Counted: PASS.draws-before, PASS.draws-after, and so on.
void count_figures(PassContext& ctx, std::string_view pass, const SceneFigures& before, const SceneFigures& after);

}  // namespace wrlkit

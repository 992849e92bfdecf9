#include "passes/expand/expand.h"

namespace wrlkit {

Outcome expand(Scene& scene, const ExpandOptions& options, PassContext& ctx) {
  const InlineOptions inlines{.depth = options.depth, .limit = options.limit};
  const ExpandProtosOptions protos{.limit = options.limit, .keep_declarations = options.keep_declarations};
  InlineRuns runs;
  bool changed = inline_within(scene, inlines, ctx, runs) == Outcome::changed;
  auto budget = expansion_budget(scene, protos);
  while (expand_within(scene, protos, ctx, budget) == Outcome::changed) {
    changed = true;
    const auto n_before = runs.n_first;
    if (inline_within(scene, inlines, ctx, runs) != Outcome::changed) break;
    budget.most += 16 * (runs.n_first - n_before);
  }
  return changed ? Outcome::changed : Outcome::unchanged;
}

}  // namespace wrlkit

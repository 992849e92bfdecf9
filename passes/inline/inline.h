// Pass `inline`: its documentation is in its options.
#pragma once
#include <memory>
#include <unordered_map>

#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct InlineOptions {
  static constexpr std::string_view doc = R"(
Replaces each Inline by the contents of the file that it names.

    Inline { url "pump.wrl" }   ->   Group { children [ ...nodes of pump.wrl... ] }

Each file is read once. All Inlines that name it share its nodes, except for nodes that events can reach: every Inline
gets its own copy of those. An Inline whose file cannot be loaded stays.

The file's DEF names, prototypes and ROUTEs are kept. They cannot be addressed from outside (ISO/IEC 14772-1, 6.25),
unless X3D exports them: a ROUTE to an imported name (ISO/IEC 19775-1, 4.4.6) then leads to the node itself.

Cost: n log n in the nodes of the files and in the copies. The copies are limited; beyond the limit, nodes are shared.)";

  int depth = 16;
  int limit = 500'000;
  void fields(auto&& f) {
    f("depth", depth, "maximum nesting of Inlines", at_least(0));
    f("limit", limit, "maximum number of nodes and ROUTEs copied for files that are inlined several times",
      at_least(0));
  }
};
/// What several runs over one scene share: the limits hold for all of them.
struct InlineRuns {
  std::unordered_map<const Scene*, std::shared_ptr<const Scene>> files;  // that were inlined
  std::size_t n_copied = 0;
  std::size_t n_first = 0;  // nodes of the files, each file counted once
  int n_runs = 0;           // each may go a level deeper than the one before
  bool full = false;
};

Outcome inline_within(Scene&, const InlineOptions&, PassContext&, InlineRuns&);
Outcome inline_worlds(Scene&, const InlineOptions&, PassContext&);

}  // namespace wrlkit

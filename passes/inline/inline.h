// Pass `inline`: its documentation is in its options.
#pragma once
#include <memory>
#include <unordered_map>

#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct InlineOptions {
  static constexpr std::string_view doc = R"(
The worlds that Inline nodes name become part of this one.

    Inline { url "pump.wrl" }   ->   Group { children [ ...nodes of pump.wrl... ] }

Each file is read once and its nodes are shared by all Inlines that name it, but for those that events can reach: each
Inline has its own. An Inline that cannot be loaded stays. The names, prototypes and ROUTEs of the file come along;
they cannot be reached by name from outside (ISO/IEC 14772-1, 6.25), but for what X3D exports: ROUTEs to imported
names (ISO/IEC 19775-1, 4.4.6) lead to the nodes themselves. Cost: n log n in the nodes of the files and in the
copies, which are limited; beyond the limit they are shared.)";

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

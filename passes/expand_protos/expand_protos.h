// Pass `expand-protos`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct ExpandProtosOptions {
  static constexpr std::string_view doc = R"(
Every instance of a prototype becomes the nodes of its body.

    PROTO Bolt [ field SFFloat r 1 ] { Shape { geometry Cylinder { radius IS r } } }
    Bolt { r 2 }   ->   Shape { geometry Cylinder { radius 2 } }

The first node of the body takes the place of the instance and keeps its DEF name (ISO/IEC 14772-1, 4.8.3); the others
are not drawn but can be reached by events: those that are part of a ROUTE and Scripts are kept, in a Switch that
shows none of them. ROUTEs of the body come along, ROUTEs to the instance go to what IS connects them to; an
exposedField without IS passes events on. EXTERNPROTOs are looked up in the files they name; an instance whose
prototype is not found stays.

Nodes are shared wherever instances cannot differ: what no IS and no event reaches is in the scene once, and instances
with equal values hold the same nodes, unless events can reach them. So a prototype that doubles itself forty times
costs forty nodes and not 2^40. Cost: n log n in what comes out, which is limited; instances beyond the limit become
empty Groups.)";

  int limit = 500'000;
  bool keep_declarations = false;
  void fields(auto&& f) {
    f("limit", limit,
      "maximum number of nodes and ROUTEs of all instances, in addition to sixteen for each node of the scene",
      at_least(0));
    f("keep-declarations", keep_declarations, "keep prototype declarations that are no longer used");
  }
};
/// How many nodes and ROUTEs instances may become, over several runs.
struct ExpansionBudget {
  std::size_t most = 0, spent = 0;
  bool full = false;
};
/// `limit`, and sixteen for each node of the world.
ExpansionBudget expansion_budget(const Scene&, const ExpandProtosOptions&);

Outcome expand_within(Scene&, const ExpandProtosOptions&, PassContext&, ExpansionBudget&);
Outcome expand_protos(Scene&, const ExpandProtosOptions&, PassContext&);

}  // namespace wrlkit

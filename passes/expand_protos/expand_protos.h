// Pass `expand-protos`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct ExpandProtosOptions {
  static constexpr std::string_view doc = R"(
Replaces each prototype instance by the nodes of the prototype's body.

    PROTO Bolt [ field SFFloat r 1 ] { Shape { geometry Cylinder { radius IS r } } }
    Bolt { r 2 }   ->   Shape { geometry Cylinder { radius 2 } }

The first node of the body takes the place of the instance and its DEF name (ISO/IEC 14772-1, 4.8.3). The other nodes of
the body are not drawn, but events can reach them. Scripts, and nodes that a ROUTE uses, are therefore kept in a Switch
that shows nothing. ROUTEs of the body are copied. A ROUTE to the instance is redirected to the fields that IS connects;
an exposedField without IS passes its events on. EXTERNPROTOs are loaded from the files they name. An instance whose
prototype is not found stays.

Values that no node of the body takes by IS, such as tags, become metadata of the instance: `Bolt { r 2 tag "B-1" }` is
a Shape with a MetadataSet of the name "Bolt", and in it a MetadataString "tag".

Nodes are shared wherever instances cannot differ. A node that no IS and no event reaches is stored once. Instances with
equal values share their nodes, unless events can reach them. A prototype that doubles itself forty times costs forty
nodes instead of 2^40.

Cost: n log n in the result, whose size is limited. Instances beyond the limit become empty Groups.)";

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

// expand-protos: every instance of a prototype becomes the nodes of its body.
//
//   PROTO Bolt [ field SFFloat r 1 ] { Shape { geometry Cylinder { radius IS r } } }
//   Bolt { r 2 }   ->   Shape { geometry Cylinder { radius 2 } }
//
// The first node of the body takes the place of the instance and keeps its DEF name (ISO/IEC 14772-1, 4.8.3); the others
// are not drawn but can be reached by ROUTEs: those that are part of one are kept, in a Switch that shows none of them.
// ROUTEs of the body come along, ROUTEs to the instance go to what IS connects them to. EXTERNPROTOs are looked up in the
// files they name; an instance whose prototype is not found stays.
//
// Only nodes that can differ between instances (an IS or a ROUTE in or below them) are copied; everything else of a body is
// shared by all instances, so a prototype that doubles itself forty times costs forty nodes and not 2^40.
// Cost: linear in what comes out, which is limited.
#pragma once
#include "passes/pass.h"

namespace wrlkit {

struct ExpandProtosOptions {
  int limit = 2'000'000;
  bool keep_declarations = false;
  void fields(auto&& f) {
    f("limit", limit, "how many nodes the instances may become");
    f("keep-declarations", keep_declarations, "keep the declarations although nothing uses them any more");
  }
};
Outcome expand_protos(Scene&, const ExpandProtosOptions&, PassContext&);

}  // namespace wrlkit

// Pass `expand`: its documentation is in its options.
#pragma once
#include "passes/expand_protos/expand_protos.h"
#include "passes/inline/inline.h"

namespace wrlkit {

struct ExpandOptions {
  static constexpr std::string_view doc = R"(
Makes one scene without Inlines and prototypes. Runs `inline` and `expand-protos` in turn until neither finds anything.

    PROTO Pump [ field MFString file [] ] { Inline { url IS file } }
    Pump { file "pump.wrl" }   ->   Group { children [ ...nodes of pump.wrl and of the Inlines in its prototypes... ] }

Prototypes may contain Inlines, and inlined files may contain prototype instances, up to `depth`. The limits apply to
all rounds together. Cost: that of both passes for each level of nesting.)";

  int depth = 16;
  int limit = 500'000;
  bool keep_declarations = false;
  void fields(auto&& f) {
    f("depth", depth, "maximum nesting of Inlines", at_least(0));
    f("limit", limit, "maximum number of nodes and ROUTEs copied for Inlines, and for instances", at_least(0));
    f("keep-declarations", keep_declarations, "keep prototype declarations that are no longer used");
  }
};
Outcome expand(Scene&, const ExpandOptions&, PassContext&);

}  // namespace wrlkit

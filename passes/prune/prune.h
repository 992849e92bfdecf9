// Pass `prune`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct PruneOptions {
  static constexpr std::string_view doc = R"(
Removes nodes without effect: Shapes without geometry, unnamed groups without children, and ROUTEs, IMPORTs and EXPORTs
that refer to nodes which are no longer in the scene.

    Group { children [ Shape { } Group { } DEF A Group { } ] }   ->   Group { children DEF A Group { } }

Nodes with a DEF name, metadata or unknown fields stay, and so do Shapes that alone hold such a node, as a library of
materials does. So do nodes that a ROUTE uses, and children of a Switch or LOD, which are addressed by number. Cost:
linear.)";

  void fields(auto&&) {}
};
Outcome prune(Scene&, const PruneOptions&, PassContext&);

}  // namespace wrlkit

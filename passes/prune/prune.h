// Pass `prune`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct PruneOptions {
  static constexpr std::string_view doc = R"(
What has no effect goes: Shapes without geometry, grouping nodes without children that nobody can name, and ROUTEs
from or to nodes that are not in the scene any more, with their IMPORTs and EXPORTs.

    Group { children [ Shape { } Group { } DEF A Group { } ] }   ->   Group { children DEF A Group { } }

Nodes with a DEF name stay, so does everything that a ROUTE touches and everything below a Switch or LOD, whose
children are counted. Cost: linear.)";

  void fields(auto&&) {}
};
Outcome prune(Scene&, const PruneOptions&, PassContext&);

}  // namespace wrlkit

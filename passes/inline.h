// inline: the worlds that Inline nodes name become part of this one.
//
//   Inline { url "pump.wrl" }   ->   Group { children [ ...nodes of pump.wrl... ] }
//
// Each file is read once and its nodes are shared by all Inlines that name it. An Inline that cannot be loaded stays. The
// names, prototypes and ROUTEs of the file come along; they cannot be reached by name from outside (ISO/IEC 14772-1, 6.25).
// Cost: linear in the nodes of the files.
#pragma once
#include "passes/pass.h"

namespace wrlkit {

struct InlineOptions {
  int depth = 16;
  void fields(auto&& f) { f("depth", depth, "how deep Inlines may be nested"); }
};
Outcome inline_worlds(Scene&, const InlineOptions&, PassContext&);

}  // namespace wrlkit

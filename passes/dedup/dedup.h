// Pass `dedup`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct DedupOptions {
  static constexpr std::string_view doc = R"(
Shares equal nodes. Exporters write a Material for each Shape, and the same bolt again at each place.

    before   Shape { appearance Appearance { material Material { diffuseColor 1 0 0 } } geometry Box {} }
             Shape { appearance Appearance { material DEF Red Material { diffuseColor 1 0 0 } } geometry Box {} }
    after    Shape { appearance DEF _1 Appearance { material DEF Red Material { ... } } geometry DEF _2 Box {} }
             Shape { appearance USE _1 geometry USE _2 }

Appearances with their materials and textures, geometries, Coordinates and the like, and FontStyles are shared if all
their values are equal. A default counts as equal whether it is written or not. Pictures are equal if they have the same
url relative to the same folder.

- Names stay. Nodes with different DEF names remain separate, but share their contents. An unnamed node is replaced by
  an equal node with a name.
- Left unchanged: nodes that a ROUTE, Script, IS or prototype instance may change, and the nodes that hold them; nodes
  with unknown fields; Shapes and groups, which are objects of their own.
- The body of each prototype is a scope of its own; nodes are shared only within it.

The scene looks the same. Cost: linear in nodes and values.)";
  static constexpr StatisticInfo statistics[] = {
      {"dedup.appearances", "Appearances saved"},
      {"dedup.materials", "materials saved"},
      {"dedup.textures", "textures saved"},
      {"dedup.geometries", "geometry nodes saved"},
      {"dedup.arrays", "Coordinates, Normals and the like saved"},
      {"dedup.others", "other nodes saved"},
      {"dedup.draws-before", "Shapes drawn before the pass"},
      {"dedup.draws-after", "Shapes drawn after the pass"},
      {"dedup.nodes-before", "nodes before the pass"},
      {"dedup.nodes-after", "nodes after the pass"},
      {"dedup.meshes-before", "geometry nodes drawn before the pass"},
      {"dedup.meshes-after", "geometry nodes drawn after the pass"},
  };

  bool named = false;

  void fields(auto&& f) {
    f("named", named,
      "also share nodes with different DEF names, if no ROUTE or Script uses them; only the first name is kept");
  }
};

Outcome dedup(Scene&, const DedupOptions&, PassContext&);

}  // namespace wrlkit

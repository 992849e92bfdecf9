// Pass `dedup`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct DedupOptions {
  static constexpr std::string_view doc = R"(
What is written several times and says the same becomes one node that is used several times. Exporters write a
Material for each Shape, and the same bolt for each place.

    before   Shape { appearance Appearance { material Material { diffuseColor 1 0 0 } } geometry Box {} }
             Shape { appearance Appearance { material DEF Red Material { diffuseColor 1 0 0 } } geometry Box {} }
    after    Shape { appearance DEF _1 Appearance { material DEF Red Material { ... } } geometry DEF _2 Box {} }
             Shape { appearance USE _1 geometry USE _2 }

Shares Appearances and all that is in them (materials, textures), geometry, Coordinates and the like, FontStyles:
those that say the same, value for value. A default that is written says the same as one that is not. A picture is the
same if its url is, below the same folder.

- Names stay: nodes of different DEF names stay what they are and share what is below; a node without a name gives way
  to one that has a name and says the same.
- Left alone: what a ROUTE, a Script, an IS or a prototype instance may change, with what holds it; nodes with fields
  that are not known; Shapes and groups, which are things of their own.
- The bodies of prototypes are scopes of their own, and share among themselves.

Nothing is seen of it. Linear in nodes and values.)";
  static constexpr StatisticInfo statistics[] = {
      {"dedup.appearances", "how many Appearances fewer there are"},
      {"dedup.materials", "how many materials fewer there are"},
      {"dedup.textures", "how many textures fewer there are"},
      {"dedup.geometries", "how many geometry nodes fewer there are"},
      {"dedup.arrays", "how many Coordinates, Normals and the like fewer there are"},
      {"dedup.others", "how many other nodes fewer there are"},
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

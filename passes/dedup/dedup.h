// What is written several times and says the same becomes one node that is used several times. Exporters write a
// Material for each Shape, and the same bolt for each place.
//
//   before   Shape { appearance Appearance { material Material { diffuseColor 1 0 0 } } geometry Box {} }
//            Shape { appearance Appearance { material DEF Red Material { diffuseColor 1 0 0 } } geometry Box {} }
//   after    Shape { appearance DEF _1 Appearance { material DEF Red Material { diffuseColor 1 0 0 } } geometry DEF _2
//   Box {} }
//            Shape { appearance USE _1 geometry USE _2 }
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct DedupOptions {
  bool named = false;

  void fields(auto&& f) {
    f("named", named, "also what has different DEF names, if no ROUTE or Script uses them; all but the first are lost");
  }
};

/// Shares Appearances and all that is in them (materials, textures), geometry, Coordinates and the like, FontStyles:
/// those that say the same, value for value. A default that is written says the same as one that is not. A picture is
/// the same if its url is, below the same folder.
///
/// - Names stay: nodes of different DEF names stay what they are and share what is below; a node without a name gives
/// way
///   to one that has a name and says the same.
/// - Left alone: what a ROUTE, a Script, an IS or a prototype instance may change, with what holds it; nodes with
/// fields
///   that are not known; Shapes and groups, which are things of their own.
/// - The bodies of prototypes are scopes of their own, and share among themselves.
///
/// Nothing is seen of it. Counted: dedup.appearances, dedup.materials, dedup.textures, dedup.geometries, dedup.arrays
/// (Coordinate, Normal, ...), dedup.others: how many fewer there are; and figures.h. Linear in nodes and values.
Outcome dedup(Scene&, const DedupOptions&, PassContext&);

}  // namespace wrlkit

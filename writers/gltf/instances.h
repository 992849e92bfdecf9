// EXT_mesh_gpu_instancing, on request: children of one parent that only place one mesh are one node with a
// table of places, and are drawn by one call.
//
//   {"name": "Bolt_1", "translation": [1, 0, 0], "mesh": 3}, {"name": "Bolt_2", "translation": [2, 0, 0], "mesh": 3},
//   ...   ->
//   {"mesh": 3, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 7}}}, "extras": {"names":
//   ["Bolt_1", "Bolt_2", ...]}}
//
// Those of several parents go together where names are in a table (document/place_tables.h), and have its rows as
// feature ids. Without one, names are in the order of the places, "" where there is none. Places are floats, whatever
// the compression: the extension knows no smaller translations and scales. Not worth it below `least_instances`: the
// extension and its accessors take what three nodes do.
#pragma once
#include <vector>

#include "scenegraph/scene.h"
#include "writers/gltf/store.h"
#include "writers/gltf/transform.h"

namespace wrlkit::gltf {

inline constexpr std::size_t least_instances = 4;
inline constexpr std::uint32_t no_part = 0xffffff;  // as a feature id, a float

struct Instances {
  std::vector<NodeId> sources;
  std::vector<Trs> places;
  std::vector<std::uint32_t> rows;                                     // of the table of names; empty: there is none
  std::uint32_t features = none;                                       // accessor of them
  std::uint32_t translations = none, rotations = none, scales = none;  // accessors; none: all are the identity
};

}  // namespace wrlkit::gltf

// Nodes that only place one mesh become rows of a table of places (instances.h).
#pragma once
#include "writers/gltf/document/document.h"
#include "writers/gltf/document/makers.h"

namespace wrlkit::gltf {

/// Whether a node may be such a row, at `place`. Nothing is lost then; `growth`: how much lengths of the frame of the
/// place grow in the world. Mirror images stay nodes: renderers take which side is the front from the node.
bool only_places_a_mesh(const Makers&, const Node&, const Trs& place, double growth = 1);

/// --gpu-instancing: children of one parent that place one mesh, at least `least_instances`, become one node.
void make_instances(Document&, const Makers&);

/// --names table: groups that only hold parts, and the parts in them, become rows of the table of names; what
/// a mesh is placed by becomes a table of places, whatever group it was in.
void make_part_rows(Document&, const Makers&, PartTable&);

/// Puts the places of instances where accessors are.
void store_instances(Document&, Store&);

}  // namespace wrlkit::gltf

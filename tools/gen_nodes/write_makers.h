// shape_makers.def: a row SHAPE(node, maker) for each node whose mesh a function of geometry/shapes/ makes.
#pragma once
#include <ostream>

#include "tools/gen_nodes/table.h"

namespace gen_nodes {

void write_makers(const NodeTable&, std::ostream&);

}  // namespace gen_nodes

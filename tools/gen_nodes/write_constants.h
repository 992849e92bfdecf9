// nodes.h: `nodes::Cone`, `nodes::cone::height` (`nodes::vrml1::cone::height` of a node that only VRML 1.0 has), and a
// bit for each abstract type, `nodes::X3DGeometryNode`.
#pragma once
#include <ostream>

#include "tools/gen_nodes/table.h"

namespace gen_nodes {

void write_constants(const NodeTable&, std::ostream&);

}  // namespace gen_nodes

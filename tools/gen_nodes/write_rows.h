// node_rows.cpp: the rows behind builtin_nodes().
#pragma once
#include <ostream>

#include "tools/gen_nodes/table.h"

namespace gen_nodes {

void write_rows(const NodeTable&, std::ostream&);

}  // namespace gen_nodes

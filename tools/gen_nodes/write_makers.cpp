#include "tools/gen_nodes/write_makers.h"

namespace gen_nodes {

void write_makers(const NodeTable& table, std::ostream& o) {
  for (auto& n : table.nodes())
    if (!n.maker.empty()) o << "SHAPE(" << n.name << ", " << n.maker << ")\n";
  o << "#undef SHAPE\n";
}

}  // namespace gen_nodes

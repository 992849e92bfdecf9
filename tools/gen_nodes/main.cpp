// Reads the node table (scenegraph/nodes/*.nodes) and writes three files into the build tree: nodes.h, node_rows.cpp
// and shape_makers.def.
//
//   gen_nodes OUT_DIR FILE.nodes...
//
// Errors are printed as file:line: text; exit code 1. It uses nothing of the library but value.h, which has the types.
#include <cstdio>
#include <fstream>

#include "tools/gen_nodes/write_constants.h"
#include "tools/gen_nodes/write_makers.h"
#include "tools/gen_nodes/write_rows.h"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: gen_nodes OUT_DIR FILE.nodes...\n");
    return 2;
  }
  gen_nodes::NodeTable table;
  for (int i = 2; i < argc; ++i) table.read(argv[i]);
  table.check_kinds();
  const std::string folder = argv[1];
  std::ofstream constants(folder + "/nodes.h");
  std::ofstream rows(folder + "/node_rows.cpp");
  std::ofstream makers(folder + "/shape_makers.def");
  write_constants(table, constants);
  write_rows(table, rows);
  write_makers(table, makers);
  return constants.good() && rows.good() && makers.good() ? 0 : 1;
}

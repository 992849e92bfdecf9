// Working memory of `weld`, used again for each geometry.
#pragma once
#include "passes/weld/coplanar.h"
#include "passes/weld/edges.h"
#include "passes/weld/faces.h"
#include "passes/weld/points.h"
#include "passes/weld/t_junctions.h"
#include "passes/weld/winding.h"

namespace wrlkit {

struct WeldScratch {
  PointJoiner joiner;
  ValueTable<float, 2> pairs;
  ValueTable<float, 3> triples;
  ValueTable<float, 4> quadruples;
  FaceCleaner cleaner;
  EdgeTable edges;
  TJunctions t_junctions;
  Winding winding;
  CoplanarMerger merger;
  std::vector<std::uint32_t> face_of, parents, fans;
};

}  // namespace wrlkit

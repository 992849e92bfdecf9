// One mesh on its way through functions that see one geometry at a time.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/task.h"
#include "geometry/mesh.h"
#include "geometry/polygon.h"
#include "scenegraph/scene.h"

namespace wrlkit {

struct NormalsScratch;  // geometry/normals_scratch.h
struct WeldScratch;     // passes/weld/scratch.h

/// Arrays that mesh passes use again and again, so that a million small shapes allocate nothing.
struct MeshScratch {
  StampedMap map;
  std::vector<std::uint32_t> a, b, c, d;
  std::vector<double> x, y;
  std::shared_ptr<NormalsScratch> normals;  // made when first used
  std::shared_ptr<WeldScratch> weld;        // the same
  PolygonCutter cutter;
};

/// A mesh on its way through mesh passes, and where it comes from.
struct MeshJob {
  const Scene& scene;
  NodeId geometry;  // the node it is made from
  Mesh& mesh;
  MeshScratch& scratch;
  Task& ctx;
  bool textured = false;  // some Shape puts a texture on it
  bool driven = false;    // its points and their order belong to something else (driven.h)
};

}  // namespace wrlkit

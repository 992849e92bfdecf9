// What a pass is: a free function over a scene, or over one mesh, with an options aggregate that describes itself.
//
//   struct PruneOptions { bool empty_groups = true; void fields(auto&& f) { f("empty-groups", empty_groups, "..."); } };
//   Outcome prune(Scene&, const PruneOptions&, PassContext&);
//
// A mesh pass sees one geometry at a time and nothing of its neighbours, so the pipeline runs several of them on a
// geometry while it is in the cache.
#pragma once
#include <map>
#include <memory>
#include <string>

#include "passes/polygon.h"
#include "scenegraph/diagnostics.h"
#include "scenegraph/mesh.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"
#include "scenegraph/verify.h"

namespace wrlkit {

enum class Outcome : std::uint8_t { unchanged, changed, failed };


/// Counts a pass wants to tell: "tessellate.triangles" and so on. Sums, so that their order does not matter.
using Statistics = std::map<std::string, std::uint64_t, std::less<>>;

/// Who is told how far a pass is that takes long.
class Monitor {
 public:
  virtual ~Monitor() = default;
  /// A new stretch of work: `total` things of that unit ("shapes"); 0: how many is not known.
  virtual void begin(std::string what, std::uint64_t total, std::string unit) = 0;
  /// So many more are done. One thread at a time.
  virtual void step(std::uint64_t n = 1) = 0;
};

struct PassContext {
  Diagnostics& diag;
  Statistics& stats;
  Resources* resources = nullptr;  // none: nothing outside the scene can be had
  Monitor* monitor = nullptr;      // none: nobody wants to know
};

/// Arrays of passes/normals.cpp, which explains them.
struct NormalsScratch {
  struct FaceNormal { float x, y, z, weight; };
  struct Edge { std::uint32_t other, link; };
  struct Seen { std::uint32_t from, edge; };

  std::vector<FaceNormal> face_normals;
  std::vector<Edge> edges;
  std::vector<Seen> seen;
  std::vector<std::uint32_t> ids, first_edge, face_of, groups, recent;
};

struct WeldScratch;  // passes/weld/scratch.h

/// Arrays that mesh passes use again and again, so that a million small shapes allocate nothing.
struct MeshScratch {
  StampedMap map;
  std::vector<std::uint32_t> a, b, c, d;
  std::vector<double> x, y;
  NormalsScratch normals;
  std::shared_ptr<WeldScratch> weld;  // made when first used
  PolygonCutter cutter;
};

/// A mesh on its way through mesh passes, and where it comes from.
struct MeshJob {
  const Scene& scene;
  NodeId geometry;   // the node it is made from
  Mesh& mesh;
  MeshScratch& scratch;
  PassContext& ctx;
  bool textured = false;  // some Shape puts a texture on it
  bool driven = false;    // its points and their order belong to somebody else (driven.h)
};

}  // namespace wrlkit

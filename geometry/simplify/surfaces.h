// The surfaces of a scene that may be simplified: which geometry nodes, in which Shapes, and their meshes.
#pragma once
#include <functional>
#include <vector>

#include "geometry/tessellation.h"

namespace wrlkit {

/// A geometry node with a surface, and the Shapes that hold it.
struct ShapeSurface {
  NodeId geometry;
  std::vector<NodeId> shapes;
};

/// What becomes of Shapes below a LOD, which have their levels already: those of any LOD are left out, or those of a
/// LOD that draws something else from afar (many have an empty second level, which only hides them), or none.
enum class BelowLod : std::uint8_t { leave, leave_levels, take };

/// Whether a LOD draws something from afar: of its levels behind the first, one holds a Shape or an instance of a
/// prototype. O(nodes in it).
bool has_coarser_level(const Scene& scene, NodeId lod);

enum class OfText : std::uint8_t { leave, take };

/// Is given each Shape with a surface that is left out, and why.
using ShapeLeft = std::function<void(NodeId shape, const char* why)>;
/// Reports not-simplified.
ShapeLeft report_not_simplified(const Scene& scene, Diagnostics& diag);

/// In the order of the scene, the bodies of prototypes too. Left out: text unless taken, lines and points; geometry
/// that is the end of a ROUTE or an IS or has such nodes; Shapes that are the end of a ROUTE or, unless taken, lie
/// below a LOD. `left` is given what is left out of surfaces and text. O(nodes).
std::vector<ShapeSurface> surfaces_of(const Scene& scene, const ShapeLeft& left = {}, BelowLod below = BelowLod::leave,
                                      OfText text = OfText::leave);

/// Makes triangles of them. One object for many surfaces, one after the other.
class SurfaceReader {
 public:
  /// `scene` must outlive it; nodes may be added. `faces`: what becomes of curved forms.
  SurfaceReader(const Scene& scene, Task& ctx, const Tessellation& faces = {.texcoords = true});

  /// A mesh of triangles, or an empty one. What nobody sees and would hold a simplification back is left out: texture
  /// coordinates without a texture, and the exact normals of Box, Cone, Cylinder and Sphere, whose edges tell the same.
  void read(const ShapeSurface& surface, Mesh& mesh);

 private:
  const Scene& scene_;
  Task& ctx_;
  Tessellation faces_;
  std::vector<char> textured_;
  MeshScratch scratch_;
};

}  // namespace wrlkit

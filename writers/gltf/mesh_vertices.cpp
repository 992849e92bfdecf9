#include "writers/gltf/mesh_vertices.h"

#include "scenegraph/nodes.h"
#include "writers/gltf/meshopt.h"

namespace wrlkit::gltf {

bool gives_texcoords(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::IndexedFaceSet)) return bool(scene.get(n, nodes::indexed_face_set::texCoord));
  return scene.is(n, nodes::ElevationGrid) && scene.get(n, nodes::elevation_grid::texCoord);
}

void make_vertices(const Mesh& mesh, const VertexOptions& options, SplitScratch& scratch, Vertices& out,
                   const std::array<double, 3>& origin) {
  const bool faces = mesh.kind == Mesh::Kind::faces;
  split_vertices(mesh,
                 {.origin = origin,
                  .normals = faces,
                  .texcoords = faces && options.texcoords,
                  .lightcoords = faces && options.lightcoords,
                  .linear_colors = true,
                  .flip_v = true},
                 scratch, out);
  if (options.ordered && faces) order_for_drawing(out);
}

}  // namespace wrlkit::gltf

// From a mesh to the vertices that a glTF stores: what a writer does with each mesh before it looks for what is stored
// already. It depends on nothing but the mesh and these options, so that it may be done ahead, on any thread.
#pragma once
#include <functional>

#include "geometry/vertices.h"
#include "scenegraph/scene.h"

namespace wrlkit::gltf {

struct VertexOptions {
  bool texcoords = true;     // of faces
  bool lightcoords = false;  // of faces: places in lightmaps
  bool ordered = false;      // triangles and vertices in the order in which they are drawn best

  bool operator==(const VertexOptions&) const = default;
};

/// Has the geometry texture coordinates of its own, which are kept without a picture?
bool gives_texcoords(const Scene&, NodeId geometry);

/// Fills `out`, cleared first; positions are relative to `origin`. Linear in the corners, but for `ordered`.
void make_vertices(const Mesh&, const VertexOptions&, SplitScratch&, Vertices& out,
                   const std::array<double, 3>& origin = {});

/// The vertices of the mesh that a source gave last for a geometry, where they were made ahead with exactly these
/// options; null: they were not. The receiver may move them away.
using VerticesAhead = std::function<Vertices*(NodeId geometry, const VertexOptions&)>;

}  // namespace wrlkit::gltf

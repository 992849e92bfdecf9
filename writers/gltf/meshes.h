// Meshes: one for each geometry and material that are used together. The vertex data of a geometry is made when it is
// first met, and shared by all meshes with it.
#pragma once
#include <map>
#include <string>
#include <unordered_map>

#include "base/diagnostics.h"
#include "geometry/vertices.h"
#include "scenegraph/transform.h"
#include "writers/gltf/box.h"
#include "writers/gltf/materials.h"
#include "writers/gltf/mesh_vertices.h"
#include "writers/gltf/morphs.h"
#include "writers/gltf/parts.h"
#include "writers/gltf/store.h"
#include "writers/gltf/transform.h"

namespace wrlkit::gltf {

enum class Mode : std::uint8_t { points = 0, lines = 1, triangles = 4 };

/// The vertex data of a geometry: accessors. Nothing to draw: no positions.
struct Geometry {
  NodeId source;
  std::uint32_t positions = none, normals = none, colors = none, texcoords = none, lightcoords = none, indices = none;
  std::uint32_t features = none;    // for each vertex the number of the part that it is of (scenegraph/features.h)
  std::uint32_t n_features = 0;     // different ones
  std::uint32_t origin = none;      // into Meshes::origins: where the positions are relative to
  std::uint32_t first_mesh = none;  // of those with it
  std::uint32_t morph = none;       // into Meshes::morphs
  std::uint32_t textured = none;    // the same geometry, with texture coordinates
  Mode mode = Mode::triangles;
  bool double_sided = false;
  bool opacity = false;           // its colours have one
  bool repeatable = false;        // equal ones have the same data: nothing was reported, and it stands still
  bool made_texcoords = false;    // its texture coordinates were asked for
  std::uint32_t polygons = none;  // into Meshes::polygons; none: all triangles
  double scale = 0;               // how many times larger it is in the world, at most, where it is shown
  double rounding = 0;            // how far single precision moves its points, where that is much

  bool empty() const { return positions == none; }
  SurfaceKind surface() const {
    return {mode == Mode::triangles, colors != none, texcoords != none, lightcoords != none, double_sided, opacity};
  }
};

struct MeshRecord {
  std::uint32_t geometry, material;
  std::uint32_t texcoords;    // those of the geometry, or baked ones
  std::uint32_t lightcoords;  // the same; none: the material shows no light
  std::uint32_t next = none;  // with the same geometry
  NodeId bake, bake_light;
  bool shows_color = true;
};

class Meshes {
 public:
  /// `ahead` may be empty.
  Meshes(const Scene& scene, const MeshSource& source, const std::function<NodeId(NodeId)>& same_mesh,
         const Motion& motion, Store& store, PartTable& parts, const VertexOptions& options, const VerticesAhead& ahead,
         Diagnostics& diag)
      : scene_(scene),
        source_(source),
        same_mesh_(same_mesh),
        store_(store),
        parts_(parts),
        options_(options),
        ahead_(ahead),
        diag_(diag),
        morphs_(scene, motion, store, diag),
        by_node_(scene.node_count(), none) {}

  /// Index into geometries() of the data of a geometry node. Texture coordinates that the file does not give are there
  /// only if there is a picture.
  std::uint32_t geometry(NodeId, bool picture);
  /// It is shown in this frame.
  void note_use(std::uint32_t geometry, const Matrix& frame) {
    Geometry& g = geometries_[geometry];
    g.scale = std::max(g.scale, largest_scale(frame));
  }
  /// Index into meshes().
  std::uint32_t mesh(std::uint32_t geometry, const MaterialUse&);

  const std::vector<Geometry>& geometries() const { return geometries_; }
  const std::vector<MeshRecord>& meshes() const { return meshes_; }
  const std::vector<Vec3>& origins() const { return origins_; }
  /// Pairs: number of triangles of a face, number of such faces in a row; empty: all are triangles.
  std::span<const std::uint32_t> polygons(const Geometry& g) const {
    return g.polygons == none ? std::span<const std::uint32_t>() : *polygons_[g.polygons];
  }
  /// Rows of the table of parts are in a mesh.
  bool any_features() const { return any_features_; }
  /// How far a mesh goes from its origin.
  double reach(std::uint32_t mesh) const {
    return gltf::reach(bounds(geometries_[meshes_[mesh].geometry], {})) * std::sqrt(3.0);
  }
  const Morphs& morphs() const { return morphs_; }
  /// The bounds of a geometry that is not empty, in a frame.
  Box bounds(const Geometry&, const Matrix&) const;

 private:
  Geometry make(NodeId, bool texcoords);
  std::uint32_t add_polygons(const std::vector<std::uint32_t>&);
  /// The data of an equal geometry; empty where there is none.
  Geometry repeated(NodeId, bool texcoords) const;
  const Mesh& mesh_of(NodeId);
  void split(const Mesh&, bool texcoords, const Vec3& origin = {});
  VertexOptions options_with(bool texcoords) const;
  bool take_vertices(NodeId, bool texcoords);
  bool number_parts(NodeId, const Mesh&);
  /// How far single precision moves its points, where that is more than a millimetre.
  double report_coarse(NodeId, const Mesh&);
  std::uint32_t move_near_origin(const Mesh&, bool texcoords);
  std::uint32_t baked(const Geometry&, NodeId texture_transform, std::vector<float> Vertices::*places);

  const Scene& scene_;
  const MeshSource& source_;
  const std::function<NodeId(NodeId)>& same_mesh_;
  Store& store_;
  PartTable& parts_;
  VertexOptions options_;
  const VerticesAhead& ahead_;
  Diagnostics& diag_;
  Morphs morphs_;
  std::vector<std::uint32_t> by_node_;
  std::vector<Geometry> geometries_;
  std::vector<MeshRecord> meshes_;
  std::vector<Vec3> origins_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> known_polygons_;  // most faces of a plant are cut alike
  std::vector<const std::vector<std::uint32_t>*> polygons_;
  bool any_features_ = false;
  std::vector<float> feature_of_corner_;  // of the mesh that is being made; empty: it has no parts
  SplitScratch scratch_;
  Mesh faceted_;
  bool moving_ = false;  // the mesh at hand: its vertices stay those of the points
  Vertices vertices_;
};

}  // namespace wrlkit::gltf

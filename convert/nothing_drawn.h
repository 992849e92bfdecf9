// Scenes of which nothing is left to draw once their meshes are made.
#pragma once
#include "base/diagnostics.h"
#include "geometry/mesh.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Passes on the meshes that a writer or a renderer asks for, and reports when there was nothing in any of them: a
/// glTF without meshes is what some scenes deserve (lights, prototype libraries), but nobody should find out later that
/// all faces had been dropped, or that what was in the file is not known.
class DrawnMeshes {
 public:
  /// All must outlive this. `n_before`: of the messages that something was dropped, those about other scenes.
  DrawnMeshes(const Scene& scene, MeshSource meshes, Diagnostics& diag, std::size_t n_before = 0);

  /// Messages so far that faces or lines were dropped. A geometry that itself says that nothing of it is drawn, such as
  /// a Cone without sides and bottom, does not count.
  static std::size_t n_dropped(const Diagnostics& diag);

  const Mesh& operator()(NodeId geometry);
  /// Once all meshes have been asked for.
  void report() const;

 private:
  const Scene& scene_;
  MeshSource meshes_;
  Diagnostics& diag_;
  std::size_t n_before_;
  NodeId first_;
  bool is_any_drawn_ = false;
};

}  // namespace wrlkit

// The meshes of a scene as people see it: prototypes and Inlines expanded, every geometry as faces and as triangles.
#pragma once
#include <optional>

#include "convert/document.h"
#include "passes/pipeline/pipeline.h"

namespace wrlkit {

class WorldMeshes {
 public:
  /// Expands the document, which must stay until the sources have been asked for the last time.
  explicit WorldMeshes(Document&);

  /// False when the scene could not be expanded.
  bool good() const { return triangles != nullptr; }

  MeshSource polygons;  // faces as authored; reports nothing: the messages come with the triangles
  MeshSource triangles;

 private:
  Diagnostics unheard_;
  PassContext silent_;
  std::optional<Pipeline> as_faces_, as_triangles_;
};

}  // namespace wrlkit

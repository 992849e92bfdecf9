#include "passes/triangulate/triangulate.h"

#include "geometry/triangulation.h"

namespace wrlkit {

Outcome triangulate(MeshJob& job, const TriangulateOptions&) {
  return cut_into_triangles(job) ? Outcome::changed : Outcome::unchanged;
}

}  // namespace wrlkit

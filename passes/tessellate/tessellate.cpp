#include "passes/tessellate/tessellate.h"

namespace wrlkit {

Outcome tessellate(MeshJob& job, const TessellateOptions& options) {
  return make_mesh(job, options) ? Outcome::changed : Outcome::unchanged;
}

}  // namespace wrlkit

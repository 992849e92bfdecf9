#include "geometry/text.h"

#include "geometry/shapes/shapes.h"

namespace wrlkit {

void make_text(MeshJob& job, const Tessellation&) { text_mesh(job); }

}  // namespace wrlkit

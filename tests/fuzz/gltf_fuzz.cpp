// What must hold of any bytes that are taken for glTF: reading, the passes and both writers do no harm, and what is
// written as VRML is read again. Files next to it are out of reach here.
#include "tests/fuzz/harness.h"

using namespace wrlkit;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto world = world_of(text_of(data, size));
  if (!world || world->format != Format::gltf) return 0;
  Diagnostics diag;
  require(parse_world(vrml_text(world->scene), "again", {}, diag) != nullptr, "what was written is not read");
  run_passes(world->scene, "expand-protos{limit=5000},prune,tessellate,normals,triangulate");
  return 0;
}

// What must hold of any bytes that are taken for glTF: reading, the passes and both writers do no harm, and what is
// written as VRML is read again. Files next to it are out of reach here.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/verify.h"
#include "writers/vrml/vrml.h"

using namespace wrlkit;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diag;
  auto world = parse_world({reinterpret_cast<const char*>(data), size}, "fuzz", {}, diag);
  for (auto& m : diag.messages()) {
    m.text();
    diag.sources().locate(m.where);
  }
  if (!world || world->format != Format::gltf) return 0;
  check_values(world->scene, diag);
  std::string text, why;
  write_vrml(
      world->scene, {}, [&](std::string_view s) { text += s; }, diag);
  if (!parse_world(text, "again", {}, diag)) {
    std::fputs("gltf_fuzz: what was written is not read\n", stderr);
    std::abort();
  }
  Statistics statistics;
  PassContext context{diag, statistics};
  auto pipeline = Pipeline::parse("expand-protos{limit=5000},prune,tessellate,normals,triangulate", why);
  if (!pipeline->run(world->scene, context, {.verify_each = true})) {
    std::fprintf(stderr, "gltf_fuzz: %s\n", diag.messages().back().text().c_str());
    std::abort();
  }
  return 0;
}

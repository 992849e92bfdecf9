// What must hold of any bytes at all that are read as X3D: what is written reads as what was written, and the world
// passes through the passes without harm. Bytes without an XML header are taken for the inside of a document, so that
// the fuzzer need not find one. main.cpp replays files.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/verify.h"
#include "writers/vrml/vrml.h"
#include "writers/x3d/x3d.h"

using namespace wrlkit;

namespace {

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "x3d_fuzz: %s\n", what.c_str());
  std::abort();
}

std::string x3d_text(const Scene& scene) {
  Diagnostics diag;
  std::string text;
  write_x3d(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
  return text;
}

void run_passes(Scene scene) {
  std::string why;
  auto pipeline =
      Pipeline::parse("expand-protos{limit=5000},lower-x3d{vrml97=true},prune,tessellate,normals,triangulate", why);
  require(pipeline.has_value(), why);
  Diagnostics diag;
  Statistics statistics;
  PassContext context{diag, statistics};
  bool good = pipeline->run(scene, context, {.verify_each = true});
  require(good,
          "a pass failed, or left what it must not: " + (diag.messages().empty() ? "" : diag.messages().back().text()));
  std::string text;
  write_vrml(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  if (sniff_format(text) == Format::none) text = "<X3D version='4.0' profile='Full'><Scene>" + text + "</Scene></X3D>";
  Diagnostics diag;
  auto world = parse_world(text, "fuzz", {}, diag);
  for (auto& m : diag.messages()) {
    m.text();
    diag.sources().locate(m.where);
  }
  if (!world) return 0;
  check_values(world->scene, diag);
  // Names may change when they are written the first time.
  Diagnostics again_diag;
  auto again = parse_world(x3d_text(world->scene), "again", {}, again_diag);
  require(again != nullptr, "what was written is not read");
  run_passes(std::move(world->scene));
  return 0;
}

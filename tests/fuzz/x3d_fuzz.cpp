// What must hold of any bytes at all that are read as X3D: what is written reads as what was written, and the world
// passes through the passes without harm. Bytes without a header are taken for the inside of an XML document, so that
// the fuzzer need not find one; in x3d_classic_fuzz (WRLKIT_CLASSIC) for what follows the header of the classic
// encoding.
#include "tests/fuzz/harness.h"
#include "tests/fuzz/world_mutator.h"

using namespace wrlkit;

namespace {

#ifdef WRLKIT_CLASSIC
constexpr auto format = Format::x3d_classic;
std::string with_header(const std::string& text) { return "#X3D V4.0 utf8\nPROFILE Full\n" + text; }
#else
constexpr auto format = Format::x3d_xml;
std::string with_header(const std::string& text) {
  return "<X3D version='4.0' profile='Full'><Scene>" + text + "</Scene></X3D>";
}
#endif

}  // namespace

#ifdef WRLKIT_LIBFUZZER
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  return mutate_in_turn(data, size, most, seed, [](std::string text, std::mt19937& random) {
    return mutated_world(std::move(text), format, random);
  });
}
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(text_of(data, size));
  if (sniff_format(text) == Format::none) text = with_header(text);
  const auto world = world_of(text);
  if (!world) return 0;
  // Names may change when they are written the first time.
  Diagnostics diag;
  const auto again = parse_world(x3d_text(world->scene), "again", {}, diag);
  require(again != nullptr, "what was written is not read");
  run_passes(world->scene, "expand-protos{limit=5000},lower-x3d{vrml97=true},prune,tessellate,normals,triangulate");
  vrml_text(world->scene);
  return 0;
}

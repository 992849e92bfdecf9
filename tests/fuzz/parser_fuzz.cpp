// What must hold of any bytes at all: a scene that was read is written and read back as the same scene; written again
// it is the same text; it passes through the passes and the checks without harm.
//
// With Clang's -fsanitize=fuzzer this is the fuzzer; otherwise main.cpp replays files, so that it always builds.
#include <algorithm>
#include <set>

#include "scenegraph/equal.h"
#include "scenegraph/walk.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/world_mutator.h"

using namespace wrlkit;

namespace {

/// A node whose name is defined again behind it gets another one where a ROUTE or USE would miss it.
bool has_name_twice(const Scene& scene) {
  std::set<std::string_view> names;
  return std::ranges::any_of(all_nodes(scene),
                             [&](NodeId n) { return !scene.name(n).empty() && !names.insert(scene.name(n)).second; });
}

/// What a name means depends on the place then, and writers put prototypes before all nodes.
bool has_ambiguous_proto(const Scene& scene) {
  std::set<std::string_view> names;
  for (std::uint32_t i = 0; i < scene.proto_count(); ++i)
    if (!names.insert(scene.type(scene.proto(ProtoId{i}).type).name).second) return true;
  auto another = [&](NodeId n) { return scene.type(n).kind != NodeKind::proto && names.count(scene.type(n).name); };
  return std::ranges::any_of(all_nodes(scene), another);
}

/// Fields that only one of them has say whether a node is one of VRML 1.0 or of X3D where both have one of that name.
/// Where none of these could be kept, nothing says it any longer.
bool has_ambiguous_type(const Scene& scene) {
  return std::ranges::any_of(all_nodes(scene), [&](NodeId n) {
    const TypeId vrml1 = find_builtin(scene.type(n).name, Dialect::vrml1);
    const TypeId x3d = find_builtin(scene.type(n).name, Dialect::x3d);
    if (!vrml1 || !x3d) return false;
    auto is_of_both = [&](const Value& v) {
      if (scene.is_extra(v)) return true;
      const FieldDef& field = scene.type(n).fields[v.slot];
      if (!v.is && equals_default(v, field)) return true;  // and not written
      const auto name = field.name;
      return builtin_nodes()[vrml1.value].find(name, Dialect::vrml1) &&
             builtin_nodes()[x3d.value].find(name, Dialect::x3d);
    };
    return std::ranges::all_of(scene.fields(n), is_of_both);
  });
}

void read_back(const Scene& scene) {
  Diagnostics diag;
  const auto text = vrml_text(scene);
  auto again = parse_world(text, "again", {}, diag);
  require(again != nullptr, "what was written is not read\n" + text);
  if (has_ambiguous_proto(scene) || has_ambiguous_type(scene)) return;
  auto other = difference(scene, again->scene);
  bool renamed = other.find(": name '") != other.npos && has_name_twice(scene);
  require(other.empty() || renamed, "what was written reads as another scene: " + other + "\n" + text);
  const auto second = vrml_text(again->scene);
  require(second == text, "written twice, not the same\n" + text + "\nthen\n" + second);
}

}  // namespace

#ifdef WRLKIT_LIBFUZZER
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  return mutate_in_turn(data, size, most, seed, [](std::string text, std::mt19937& random) {
    return mutated_world(std::move(text), random() % 4 ? Format::vrml97 : Format::vrml1, random);
  });
}
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto world = world_of(text_of(data, size));
  if (!world) return 0;
  if (world->format == Format::vrml97) read_back(world->scene);
  run_passes(
      world->scene,
      "lower-vrml1{limit=5000},expand-protos{limit=5000},lower-x3d{vrml97=true},prune,tessellate,normals,triangulate");
  vrml_text(world->scene);
  return 0;
}

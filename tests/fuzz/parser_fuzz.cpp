// What must hold of any bytes at all: a scene that was read is written and read back as the same scene; written again
// it is the same text; it passes through the passes and the checks without harm. Breaches abort with a message, so that
// libFuzzer keeps the bytes. Files, and with them Inline and EXTERNPROTO, are out of reach here.
//
// With Clang's -fsanitize=fuzzer this is the fuzzer; otherwise main.cpp replays files, so that it always builds.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/equal.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"
#include "writers/vrml/vrml.h"

using namespace wrlkit;

namespace {

void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "parser_fuzz: %s\n", what.c_str());
  std::abort();
}

std::string text_of(const Scene& scene) {
  Diagnostics diag;
  std::string text;
  write_vrml(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
  return text;
}

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

void read_back(const Scene& scene) {
  Diagnostics diag;
  const auto text = text_of(scene);
  auto again = parse_world(text, "again", {}, diag);
  require(again != nullptr, "what was written is not read\n" + text);
  if (has_ambiguous_proto(scene)) return;
  auto other = difference(scene, again->scene);
  bool renamed = other.find(": name '") != other.npos && has_name_twice(scene);
  require(other.empty() || renamed, "what was written reads as another scene: " + other + "\n" + text);
  const auto second = text_of(again->scene);
  require(second == text, "written twice, not the same\n" + text + "\nthen\n" + second);
}

void run_passes(Scene scene) {
  std::string why;
  constexpr auto passes =
      "lower-vrml1{limit=5000},expand-protos{limit=5000},lower-x3d{vrml97=true},prune,tessellate,normals,triangulate";
  auto pipeline = Pipeline::parse(passes, why);
  require(pipeline.has_value(), why);
  Diagnostics diag;
  Statistics statistics;
  PassContext context{diag, statistics};
  bool good = pipeline->run(scene, context, {.verify_each = true});
  require(good,
          "a pass failed, or left what it must not: " + (diag.messages().empty() ? "" : diag.messages().back().text()));
  text_of(scene);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diag;
  auto world = parse_world({reinterpret_cast<const char*>(data), size}, "fuzz", {}, diag);
  for (auto& m : diag.messages()) {
    m.text();
    diag.sources().locate(m.where);
  }
  if (!world) return 0;
  check_values(world->scene, diag);
  if (world->format == Format::vrml97) read_back(world->scene);
  run_passes(std::move(world->scene));
  return 0;
}

// What the harnesses have in common. Breaches of what must hold abort with a message, so that libFuzzer keeps the
// bytes.
#pragma once
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/verify.h"
#include "writers/vrml/vrml.h"
#include "writers/x3d/x3d.h"

namespace wrlkit {

inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "breach: %s\n", what.c_str());
  std::abort();
}

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

inline std::string vrml_text(const Scene& scene) {
  Diagnostics diag;
  std::string text;
  write_vrml(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
  return text;
}

inline std::string x3d_text(const Scene& scene) {
  Diagnostics diag;
  std::string text;
  write_x3d(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
  return text;
}

/// Every message has a text and a place.
inline void say_all(Diagnostics& diag) {
  for (auto& m : diag.messages()) {
    m.text();
    diag.sources().locate(m.where);
  }
}

/// The world that bytes are, its values checked; null when they are none. Files next to it are out of reach.
inline std::unique_ptr<World> world_of(std::string_view bytes) {
  Diagnostics diag;
  auto world = parse_world(bytes, "fuzz", {}, diag);
  if (world) check_values(world->scene, diag);
  say_all(diag);
  return world;
}

/// Passes that fail nowhere, and leave what they promise.
inline void run_passes(Scene& scene, std::string_view passes) {
  std::string why;
  auto pipeline = Pipeline::parse(passes, why);
  require(pipeline.has_value(), why);
  Diagnostics diag;
  Statistics statistics;
  PassContext context{diag, statistics};
  const bool good = pipeline->run(scene, context, {.verify_each = true});
  require(good,
          "a pass failed, or left what it must not: " + (diag.messages().empty() ? "" : diag.messages().back().text()));
}

}  // namespace wrlkit

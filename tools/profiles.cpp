#include "tools/profiles.h"

#include <fmt/format.h>

#include <algorithm>

namespace wrlkit {
namespace {

#define WRLKIT_SHARING "dedup,instance"
constexpr Profile all[] = {
    {"portable", "every viewer of glTF 2.0", "none", "facts", "keep", WRLKIT_SHARING, "core glTF: no extension that a viewer must know; equal parts share a mesh, each has a node"},
    {"three", "three.js, Babylon.js, model-viewer, glTF-Transform", "meshopt", "facts", "webp", WRLKIT_SHARING, "their decoder of meshopt is small and fast; it must be given to the loader (GLTFLoader.setMeshoptDecoder)"},
    {"cesium", "CesiumJS 1.98 and later", "meshopt", "facts", "webp", WRLKIT_SHARING, "meshopt and quantised numbers are decoded without being asked for"},
    {"unity", "Unity by glTFast", "quantize", "facts", "keep", WRLKIT_SHARING, "quantised numbers need no further package; meshopt and Draco do"},
    {"godot", "Godot 4", "none", "facts", "keep", WRLKIT_SHARING, "its importer has no decoder of meshopt or Draco"},
};

}  // namespace

std::span<const Profile> profiles() { return all; }

const Profile* find_profile(std::string_view name) {
  auto i = std::ranges::find(all, name, &Profile::name);
  return i == std::end(all) ? nullptr : i;
}

std::string profile_text(const Profile& p) {
  return fmt::format("{}: {}\n  --compress {} --extras {} --texture-format {}\n  optimize runs {}\n  {}\n", p.name, p.opens_in, p.compress, p.extras, p.texture_format, p.pipeline, p.why);
}

std::string profiles_page() {
  std::string out = "# Profiles\n\nGenerated from `tools/profiles.cpp` by `script/docs`; do not edit. `wrlkit optimize --profile NAME --print-profile` prints one.\n"
                    "What an option says otherwise holds; `convert --profile NAME` takes the first three and runs no pass of its own.\n\n| profile | opens in | `--compress` | `--extras` | `--texture-format` | `optimize` runs | why |\n|---|---|---|---|---|---|---|\n";
  for (const Profile& p : all) out += fmt::format("| {} | {} | {} | {} | {} | `{}` | {} |\n", p.name, p.opens_in, p.compress, p.extras, p.texture_format, p.pipeline, p.why);
  return out;
}

}  // namespace wrlkit

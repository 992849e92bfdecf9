#include "convert/profiles.h"

#include <fmt/format.h>

#include <algorithm>

namespace wrlkit {
namespace {

#define WRLKIT_SHARING "dedup,instance"
// Where vertices are packed, what has no name is better one mesh than many nodes.
#define WRLKIT_PACKED WRLKIT_SHARING ",merge{parts=true}"
using Method = GltfCompression::Method;
using Pictures = GltfTextures::Format;
using Names = GltfOptions::Names;
constexpr Profile known_profiles[] = {
    {"portable", "every viewer of glTF 2.0", Method::none, Extras::facts, Pictures::keep, Names::nodes, SkyAs::none,
     WRLKIT_SHARING, "core glTF: no extension that a viewer must know; equal parts share a mesh, each has a node"},
    {"three", "three.js, Babylon.js, model-viewer, glTF-Transform", Method::meshopt, Extras::facts, Pictures::webp,
     Names::nodes, SkyAs::none, WRLKIT_PACKED,
     "their decoder of meshopt is small and fast; three.js must be given it (GLTFLoader.setMeshoptDecoder)"},
    {"cesium", "CesiumJS", Method::meshopt, Extras::facts, Pictures::webp, Names::table, SkyAs::none,
     WRLKIT_PACKED ",merge{instanced=true}",
     "meshopt, quantised numbers and WebP are decoded without being asked for; names in a table are what it picks by: "
     "few draws, every part still found"},
    {"unity", "Unity by glTFast", Method::quantize, Extras::facts, Pictures::keep, Names::nodes, SkyAs::none,
     WRLKIT_SHARING, "quantised numbers need no further package; meshopt and Draco do"},
    {"godot", "Godot 4", Method::none, Extras::facts, Pictures::webp, Names::nodes, SkyAs::none, WRLKIT_SHARING,
     "its importer knows WebP, but neither quantised numbers nor a decoder of meshopt or Draco"},
};

/// Where the content of the table can be read, as Markdown.
struct Source {
  std::string_view profile, text;
};
constexpr Source sources[] = {
    {"portable",
     "[the specification](https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html) has PNG and JPEG, and floats for "
     "positions"},
    {"three",
     "[GLTFLoader](https://threejs.org/docs/pages/GLTFLoader.html) lists EXT_meshopt_compression, "
     "KHR_mesh_quantization, EXT_texture_webp, EXT_mesh_gpu_instancing"},
    {"cesium",
     "`supportedExtensions` in "
     "[ModelUtility.js](https://github.com/CesiumGS/cesium/blob/main/packages/engine/Source/Scene/Model/"
     "ModelUtility.js) has EXT_meshopt_compression, KHR_mesh_quantization, EXT_texture_webp, EXT_mesh_gpu_instancing, "
     "EXT_mesh_features, EXT_instance_features, EXT_structural_metadata"},
    {"unity",
     "[its installation](https://docs.unity3d.com/Packages/com.unity.cloud.gltfast@6.15/manual/installation.html) "
     "names a package each for meshopt and Draco; KHR_mesh_quantization is supported as [issue "
     "354](https://github.com/atteneder/glTFast/issues/354) says"},
    {"godot",
     "[pull request 120205](https://github.com/godotengine/godot/pull/120205), open in June 2026, would add Draco, "
     "meshopt and KHR_mesh_quantization, and [proposal "
     "8787](https://github.com/godotengine/godot-proposals/issues/8787) EXT_mesh_gpu_instancing; WebP is in "
     "`modules/gltf/extensions/gltf_document_extension_texture_webp.cpp`"},
};

}  // namespace

std::string recognising(const Profile& p) {
  static constexpr std::string_view sharing = WRLKIT_SHARING;
  const std::string_view places = p.names == Names::nodes ? ",form-places=32" : "";
  return "recognise{split=false}," WRLKIT_SHARING "{forms=true" + std::string(places) + '}' +
         std::string(p.pipeline.substr(sharing.size()));
}

std::span<const Profile> profiles() { return known_profiles; }

const Profile* find_profile(std::string_view name) {
  auto i = std::ranges::find(known_profiles, name, &Profile::name);
  return i == std::end(known_profiles) ? nullptr : i;
}

void apply_profile(SaveOptions& options, const Profile& profile, const std::function<bool(std::string_view)>& stays) {
  const auto take = [&](std::string_view name, auto& option, auto chosen) {
    if (!stays || !stays(name)) option = chosen;
  };
  take("compress", options.compress, profile.compress);
  take("extras", options.extras, profile.extras);
  take("texture-format", options.texture_format, profile.texture_format);
  take("names", options.names, profile.names);
  take("sky", options.sky, profile.sky);
}

std::string profile_text(const Profile& p) {
  return fmt::format(
      "{}: {}\n  --compress {} --extras {} --texture-format {} --names {} --sky {}\n  optimize runs {}\n  {}\n", p.name,
      p.opens_in, name_of(p.compress), name_of(p.extras), name_of(p.texture_format), name_of(p.names), name_of(p.sky),
      p.pipeline, p.why);
}

std::string profiles_page() {
  std::string out =
      "# Profiles\n\nGenerated from `convert/profiles.cpp` by `script/docs`; do not edit. `wrlkit optimize --profile "
      "NAME --print-profile` prints one.\n"
      "Options override the profile. `convert --profile NAME` takes the first five columns and runs no pass of its "
      "own. `--recognise` puts `recognise{split=false}` in front, and has `instance` share forms.\n\n| profile | opens "
      "in | `--compress` | `--extras` | `--texture-format` | `--names` | `--sky` | "
      "`optimize` "
      "runs | why |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const Profile& p : known_profiles)
    out +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | `{}` | {} |\n", p.name, p.opens_in, name_of(p.compress),
                    name_of(p.extras), name_of(p.texture_format), name_of(p.names), name_of(p.sky), p.pipeline, p.why);
  out += "\nWhere that can be read:\n\n";
  for (const Source& from : sources) out += fmt::format("- {}: {}.\n", from.profile, from.text);
  out +=
      "\nWhat was seen (test `profiles`: Babylon.js 9.28 and CesiumJS 1.145 in headless Chromium; a plant with names "
      "and "
      "copies, a world with pictures, one with levels of detail):\n\n"
      "- Babylon.js, profiles portable and three, and three with `--compress draco` or `--gpu-instancing`: no warning, "
      "the "
      "picture of `wrlkit render` (outlines 99.7 % the same), every named part found as a node. Parts that "
      "`--gpu-instancing` puts into a table have no node of their own. Levels of MSFT_lod are loaded from coarse to "
      "fine; the finest one stays, whatever the distance. Its decoders of meshopt and Draco come from Babylon's "
      "servers unless "
      "`MeshoptCompression.Configuration` and `DracoDecoder.DefaultConfiguration` name others.\n"
      "- CesiumJS, profile cesium: no warning, the same outlines; parts under the pointer have their names. It ignores "
      "the lights of a file and MSFT_lod, and shows the finest level.\n"
      "- three.js: see the tests `three-*` in `tests/browser/README.md`.\n"
      "- Unity and Godot: not run here.\n";
  return out;
}

}  // namespace wrlkit

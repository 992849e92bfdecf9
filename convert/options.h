// What may be chosen when a file is read and when it is written. Each option describes itself in fields(): the command
// line, recipes, the keywords of Python and the pages of the documentation read that description.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/choice.h"
#include "base/diagnostics.h"
#include "base/image/image.h"
#include "base/option_range.h"
#include "passes/combine_lightmap/lightmap_size.h"
#include "passes/pipeline/length_option.h"
#include "passes/place/place.h"
#include "writers/copied_files.h"
#include "writers/gltf/gltf.h"

namespace wrlkit {

/// What VRML has and glTF has not: kept whole, so that the same VRML can be made again; only what nodes say that draw
/// nothing (links, descriptions); dropped.
enum class Extras : std::uint8_t { all, facts, none };
template <>
inline constexpr auto choices<Extras> = choice_row({{"all", "enough to write the same VRML again"},
                                                    {"facts", "links, descriptions and other nodes that draw nothing"},
                                                    {"none"}});

/// What becomes of a Background, which glTF has none of.
enum class SkyAs : std::uint8_t { none, mesh, picture };
template <>
inline constexpr auto choices<SkyAs> = choice_row({{"none", "kept in extras"},
                                                   {"mesh", "a dome around the scene, and a cube with its pictures"},
                                                   {"picture", "the same, and an equirectangular NAME.sky.png"}});

/// What fields() may add to the name, the value and the help of an option.
struct OptionNote {
  OptionRange range = {};      // of a number
  std::string_view type = {};  // what kind of value it is, where its C++ type does not say so: "LENGTH"
};

struct LoadOptions {
  Unit unit = Unit::m;                        // what one unit of the file is
  UpAxis up = UpAxis::y;                      // which of its axes points up
  std::vector<std::string> allow_paths = {};  // folders that pictures and Inlines may lie in, other than the file's own
  /// Pictures, sounds, films and scenes above the file's own folder may be read, too: as far up as its project reaches
  /// (base/io/project_folder.h). For people who open their own files; not for programs that open anybody's.
  bool project_files = false;
  /// Large files are mapped, not read: less memory, and SIGBUS when another program shortens one meanwhile.
  bool map_files = false;
  bool gltf_in_metres = false;                             // unit and up are not those of glTF, whose own are given
  bool strict = false;                                     // every warning is an error
  bool show_all = false;                                   // Switches that are off show everything
  bool run_startup = false;                                // Scripts do what they do when a browser loads the world
  bool in_place = false;                                   // an output may take the place of the file that is read
  std::vector<std::pair<Diag, Severity>> severities = {};  // of single messages
  bool unpack_pictures = false;  // pictures inside a glTF file become files that a writer places next to its own

  void placing_fields(auto&& f) {
    f("unit", unit, "unit of length of the input");
    f("up", up, "axis of the input that points up");
    f("show-all", show_all, "show all children of Switches that are off; see wrlkit passes switch");
    f("run-startup", run_startup, "run what Scripts do when a browser loads the scene; see wrlkit passes startup");
  }
  void fields(auto&& f) {
    placing_fields(f);
    f("allow-path", allow_paths, "allow files below this folder to be read (Inlines, textures)");
    f("strict", strict, "treat every repair as an error");
  }
};

struct SaveOptions {
  /// Passes to run, or the name of a pipeline; what the format needs is added. None: what the format needs.
  std::optional<std::string> pipeline = {};

  // glTF
  GltfOptions::Lightmaps lightmap_as = GltfOptions::Lightmaps::base_color;
  LightmapSize lightmap_size = {};  // of VRML and X3D, too
  bool animation_pointer = false;
  SkyAs sky = SkyAs::none;
  GltfOrigin origin = {};
  GltfOptions::Hidden hidden = GltfOptions::Hidden::dropped;
  GltfOptions::Behaviour behaviour = GltfOptions::Behaviour::extras;
  GltfCompression::Method compress = GltfCompression::Method::none;
  LengthOption tolerance = {};  // 0: a millimetre, or less in a small scene
  int position_bits = 0, normal_bits = 8, texcoord_bits = 12, draco_level = 7, color_bits = 10;
  Extras extras = Extras::all;
  GltfTextures::Format texture_format = GltfTextures::Format::keep;
  int texture_quality = 85, texture_size = 0;
  bool gpu_instancing = false;
  GltfOptions::Names names = GltfOptions::Names::nodes;
  bool measure_gzip = false;  // for the summary

  // VRML and X3D
  bool gzip = false, dump = false;
  int precision = 0;
  bool link = false;              // files that are referred to are not copied
  bool embed = false;             // pictures become part of what is written
  std::string files_folder = {};  // of copied files; empty: named after the output
  bool own_folder = false;        // pictures next to the output lie in a folder named after it, where no other's can be
  MirroredFiles is_mirrored = {};  // files that stand to the output as they do to the input: their urls stay
  bool is_derived = false;         // the name of the output: replacing a file of other contents is reported

  void light_fields(auto&& f) {
    f("lightmap-as", lightmap_as, "baked light in glTF");
    f("animation-pointer", animation_pointer,
      "glTF: animate colours, transparency, lights and fieldOfView with KHR_animation_pointer, which few viewers "
      "support");
    f("sky", sky, "Background in glTF");
    f("hidden", hidden, "children that a Switch hides, in glTF");
    f("behaviour", behaviour, "ROUTEs in glTF");
  }
  void baked_fields(auto&& f) {
    f("lightmap-size", lightmap_size,
      "maximum size of all pictures with baked light, in bytes (300k) or texels (512x512); the least visible details "
      "go first",
      OptionNote{.type = LightmapSize::type});
  }
  void size_fields(auto&& f) {
    f("compress", compress, "vertices in glTF");
    f("tolerance", tolerance,
      "maximum distance by which quantization moves a vertex: 1mm, 0.1in; plain numbers are metres; default: 1mm, or "
      "less in a small scene",
      OptionNote{.type = "LENGTH"});
    f("position-bits", position_bits, "bits per coordinate, over the extent of each mesh; instead of --tolerance",
      OptionNote{between(1, 16)});
    f("normal-bits", normal_bits, "bits per component of a normal", OptionNote{between(2, 8)});
    f("texcoord-bits", texcoord_bits, "bits per texture coordinate; two more for lightmaps",
      OptionNote{between(1, 16)});
    f("draco-level", draco_level, "effort of Draco, from 0 (fast) to 10 (small)", OptionNote{between(0, 10)});
    f("extras", extras, "what glTF cannot express, in extras");
    f("texture-format", texture_format, "pictures in glTF");
    f("texture-quality", texture_quality, "quality of JPEG and WebP pictures", OptionNote{between(1, 100)});
    f("texture-size", texture_size, "maximum length of the longer side of pictures in glTF, in pixels; 0: unlimited",
      OptionNote{between(0, static_cast<double>(max_image_side)), "PIXELS"});
    f("gpu-instancing", gpu_instancing,
      "glTF: write four or more nodes of one parent that only place the same mesh as a table of places, drawn in one "
      "call (EXT_mesh_gpu_instancing; not every viewer supports it)");
    f("names", names, "names of parts in glTF");
    f("origin", origin,
      "place of the scene that becomes the origin of glTF, in metres; auto: one in its middle where it is far away; "
      "none: its own",
      OptionNote{.type = GltfOrigin::type});
    f("color-bits", color_bits, "bits per component of a colour, in linear light", OptionNote{between(1, 16)});
  }
  void file_fields(auto&& f) {
    f("link", link,
      "refer to files outside the output's folder where they are, instead of copying them into a folder next to it "
      "(out/room_files for out/room.wrl)");
    f("embed", embed,
      "store pictures of VRML and X3D, and of extras in glTF, in the output itself, as data URLs; also the contents of "
      "Inlines");
  }
  void text_fields(auto&& f) {
    f("gzip", gzip, "compress VRML and X3D output with gzip");
    f("dump", dump, "write wrlkit's own fields to VRML, too, which no browser knows: the scene as passes leave it");
    f("precision", precision, "significant digits of numbers in VRML and X3D; 0: as many as needed",
      OptionNote{between(0, 17)});
  }
  void fields(auto&& f) {
    light_fields(f);
    baked_fields(f);
    size_fields(f);
    file_fields(f);
    text_fields(f);
  }
};

/// The options of the glTF writer that these choose.
GltfOptions gltf_options(const SaveOptions&, bool binary);

}  // namespace wrlkit

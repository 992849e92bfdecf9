// A scene as glTF 2.0. What becomes of each node type is written in the headers of this folder: document/hierarchy
// (grouping nodes, LOD, Switch), transform, meshes, materials, textures, texture_transform, lights, cameras, motion
// (what ROUTEs move), animations, morphs, pointers, origin (large coordinates), extras (everything else).
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/choice.h"
#include "base/io/sink.h"
#include "geometry/mesh.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"
#include "writers/gltf/mesh_vertices.h"
#include "writers/gltf/origin_option.h"
#include "writers/led_urls.h"

namespace wrlkit {

/// How vertices and indices are stored. none: as floats. quantize: in fewer bits (KHR_mesh_quantization). meshopt:
/// that, in the order in which they are drawn best, and packed (EXT_meshopt_compression). draco: in fewer bits and
/// packed, each mesh by itself (KHR_draco_mesh_compression), where that is smaller; lines and points stay floats.
struct GltfCompression {
  enum class Method : std::uint8_t { none, quantize, meshopt, draco };

  Method method = Method::none;
  double tolerance = 0;   // metres of the world that no vertex moves further; 0: a millimetre, or less in a small world
  int position_bits = 0;  // instead of that: of the extent of each mesh; 0: by the tolerance
  int normal_bits = 8, texcoord_bits = 12, color_bits = 10;
  int level = 7;  // of Draco: from 0, fast, to 10, small
};
template <>
inline constexpr auto choices<GltfCompression::Method> = choice_row({{"none", "as floats"},
                                                                     {"quantize",
                                                                      "as integers (KHR_mesh_quantization)"},
                                                                     {"meshopt", "quantized and compressed"},
                                                                     {"draco", "smaller, but each mesh by itself"}});

/// How pictures are stored. keep: PNG and JPEG as they are, others as PNG. jpeg, webp: colour pictures in that format
/// where that is smaller, see recoding.h.
struct GltfTextures {
  enum class Format : std::uint8_t { keep, png, jpeg, webp };

  Format format = Format::keep;
  int quality = 85;  // of JPEG and WebP, from 1 to 100
  int size = 0;      // pixels along the longer side, at most; 0: as they are
};
template <>
inline constexpr auto choices<GltfTextures::Format> =
    choice_row({{"keep", "PNG and JPEG as they are"},
                {"png"},
                {"jpeg", "for colours without alpha, where it is smaller"},
                {"webp", "for colours, where it is smaller (EXT_texture_webp)"}});

/// What was written.
struct GltfSummary {
  /// Largest differences between what is stored and what was there.
  struct Quantization {
    double tolerance = 0, position = 0;  // metres of the world
    double rounding = 0;                 // the same, by single precision far from an origin; whatever the tolerance
    double placement = 0;                // the same, for numbers of nodes; not above this
    double normal = 0;                   // radians
    double texcoord = 0, color = 0;      // parts of a picture; of the full range
    std::size_t kept = 0;                // accessors that had to stay floats
  };
  /// Pictures that were decoded and encoded again.
  struct Recoding {
    std::size_t pictures = 0, resized = 0;
    std::uint64_t before = 0, after = 0;  // bytes
    double psnr = 0;  // of the worst of those with a loss, against its pixels at the new size, in dB; 0: there is none
  };
  std::size_t nodes = 0, named = 0, meshes = 0, draws = 0, triangles = 0;
  std::size_t instances = 0;  // places in tables of EXT_mesh_gpu_instancing; a table is one node and one draw
  std::uint64_t json = 0, geometry = 0, pictures = 0;  // bytes
  std::uint64_t json_gzip = 0, geometry_gzip = 0,
                pictures_gzip = 0;  // the same, gzipped each by itself; 0: not measured
  using Share = std::pair<std::string_view, std::uint64_t>;
  std::vector<Share> json_shares, geometry_shares;  // how many of those bytes are of what kind, the most first
  Quantization quantization;
  Recoding recoding;
  std::uint64_t bytes() const { return json + geometry + pictures; }
};

struct GltfOptions {
  enum class Images : std::uint8_t { automatic, embedded, beside };
  /// What becomes of lightmaps. base_color: the pass combine-lightmap has made textures of them, nothing is left to do.
  /// The others leave surfaces as they are and write the light at texture coordinates of its own: emissive (the pass
  /// has put the surfaces' colours into it, and nothing else is seen but highlights), occlusion (its brightness dims
  /// ambient light), moz (extension MOZ_lightmap), extras (of the material, with the directions of the light).
  enum class Lightmaps : std::uint8_t { base_color, emissive, occlusion, moz, extras };

  bool binary = true;                 // .glb; false: .gltf with a .bin next to it
  Images images = Images::automatic;  // in the binary part, or files next to it; automatic: as `binary`
  Lightmaps lightmaps = Lightmaps::base_color;
  GltfCompression compression;
  GltfTextures textures;
  bool measure_gzip = false;  // for the summary
  GltfOrigin origin;
  bool says_origin = true;  // that a scene was moved is reported
  bool lights = true, cameras = true, animations = true;
  bool animation_pointer = false;  // animations of colours and the like, by KHR_animation_pointer
  /// Where names of parts stand. table: in a property table (EXT_structural_metadata), with places of equal meshes as
  /// tables, too; groups that only hold parts are rows then (parts.h).
  enum class Names : std::uint8_t { nodes, table };
  Names names = Names::nodes;
  /// Files that parts are from, sorted: what the names on the way to a part begin with. The table has a column
  /// "source".
  std::vector<std::string> sources = {};
  bool gpu_instancing =
      false;                // children that only place one mesh as a table, by EXT_mesh_gpu_instancing (instances.h)
  bool own_folder = false;  // pictures next to a .gltf lie in a folder that is named after it
  bool extras = true;       // what glTF cannot express is kept
  bool facts_only =
      false;  // of that, what nodes say that draw nothing, Anchors and the like; not what only serves to make
              // the same VRML again. Groups without a name that hold one node are then one node with it
  LeadUrls lead_urls = {};  // what urls are written as that glTF has no place for; none: as they are
  /// A geometry that the source was asked for before, and whose mesh is that of this one; none: it is not known.
  std::function<NodeId(NodeId)> same_mesh = {};
  gltf::VerticesAhead vertices_ahead = {};
  /// What Switches do not show. dropped: it is not in the hierarchy. invisible: by KHR_node_visibility.
  enum class Hidden : std::uint8_t { dropped, invisible };
  Hidden hidden = Hidden::dropped;
  /// What ROUTEs do beyond animations. extras: it is kept for programs that read VRML's ROUTEs. interactivity: as a
  /// graph of KHR_interactivity, where its nodes can say it (interactivity/events.h); Switches that it sets keep all
  /// children, as nodes that are not visible.
  enum class Behaviour : std::uint8_t { extras, interactivity };
  Behaviour behaviour = Behaviour::extras;
  /// Nodes that whoever reads this file draws or plays from extras: they are not reported as lost; none: no node is.
  std::function<bool(NodeId)> is_understood = {};
  std::size_t max_nodes = 10'000'000;  // each way to a shared node is a node of its own
};
template <>
inline constexpr auto choices<GltfOptions::Lightmaps> = choice_row({{"base-color", "in the texture of unlit materials"},
                                                                    {"emissive"},
                                                                    {"occlusion", "brightness only"},
                                                                    {"moz", "as MOZ_lightmap"},
                                                                    {"extras", "for programs that read it there"}});
template <>
inline constexpr auto choices<GltfOptions::Hidden> = choice_row(
    {{"dropped", "left out"},
     {"invisible", "hidden nodes that a viewer can show (KHR_node_visibility; viewers without it show them)"}});
template <>
inline constexpr auto choices<GltfOptions::Behaviour> = choice_row(
    {{"extras", "kept, but not run by viewers"},
     {"interactivity", "a graph of clicks, sensors, clocks and Switches that viewers run (KHR_interactivity)"}});
template <>
inline constexpr auto choices<GltfOptions::Names> =
    choice_row({{"nodes", "a node for each part"},
                {"table",
                 "a table of names and groups for instances and merged meshes (EXT_structural_metadata, "
                 "EXT_mesh_gpu_instancing; with --extras facts)"}});

namespace gltf {

/// What is asked of the vertices of every mesh, but for texture coordinates, which are those of a mesh that shows a
/// picture or whose node gives some.
VertexOptions vertex_options(const GltfOptions&);

}  // namespace gltf

/// Writes a scene without instances of prototypes; Inlines that were loaded must have become groups. It is written
/// whole or not at all; false, and a message, when it is not. Other files are named after the output: room.gltf has
/// room.bin and room_brick.png. Without resources there are only the pictures of PixelTexture.
///
/// The mesh source must give what is to be drawn: triangles with normals, and with texture coordinates wherever a Shape
/// shows a picture; segments or polylines; points. Other faces are cut into fans. Each geometry is asked for once, in
/// the order of the file (again when a TextureTransform has to be applied to its texture coordinates).
///
/// The same scene gives the same bytes. Memory: about the size of the output without compression plus with it, plus
/// one mesh.
bool write_gltf(const Scene&, const MeshSource&, const GltfOptions&, Resources*, const std::string& path, Diagnostics&,
                GltfSummary* = nullptr);

/// The same as one .glb with its pictures, piece by piece to a sink, whatever `binary` and `images` say.
bool write_glb(const Scene&, const MeshSource&, const GltfOptions&, Resources*, const Sink&, Diagnostics&);

}  // namespace wrlkit

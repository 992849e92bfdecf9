// Pass `combine-lightmap`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/picture_format/picture_format.h"
#include "passes/pipeline/pass.h"
#include "passes/pipeline/size_option.h"

namespace wrlkit {

/// Texels for each texel of the light along each side.
struct TexelFactor {
  static constexpr std::string_view type = "integer or auto";
  int value = 0;  // 0: auto
  bool read(std::string_view text);
  std::string print() const { return value ? std::to_string(value) : "auto"; }
};

enum class CombineTarget : std::uint8_t { texture, automatic, vertex, lightmap };
template <>
inline constexpr auto choices<CombineTarget> =
    choice_row({{"texture", "VRML's one texture"},
                {"auto", "colours at the corners where they are as good for fewer bytes, otherwise the texture"},
                {"vertex", "colours at the corners of all opaque Shapes without a picture"},
                {"lightmap", "the lightmap shows the combined colours; all else stays"}});

enum class CombinedFormat : std::uint8_t { as_light, png, jpg, webp };
template <>
inline constexpr auto choices<CombinedFormat> =
    choice_row({{"auto", "that of the lightmaps, but JPEG only without alpha"}, {"png"}, {"jpg"}, {"webp"}});

/// Why this build cannot write it; empty when it can.
std::string why_missing(CombinedFormat);

struct CombineLightmapOptions {
  static constexpr std::string_view doc = R"(
Combines a surface's colour and its baked light into one picture. VRML has one texture per Shape, so two textures with
different coordinates become one, with the coordinates of the lightmap:

    Shape {                                                   Shape {
      appearance Appearance {                                   appearance Appearance {
        material Material { diffuseColor 0.9 0.7 0.5 }            texture ImageTexture { url "room.baked_0.png" ... }
        texture ImageTexture { url "brick.png" }                  textureTransform TextureTransform { ... }
        lightmap ImageTexture { url "light.png" }               }
        lightmapTransform TextureTransform { ... }        ->    geometry IndexedFaceSet {
      }                                                           texCoord TextureCoordinate { point [ 0.1 0.1, ... ] }
      geometry IndexedFaceSet {                                   ...
        texCoord ...                                            }
        lightCoord TextureCoordinate { point [ 0.1 0.1, ... ] } }
      }
    }

The result has no Material. Without one, a Shape is not lit and shows its texture unchanged (ISO/IEC 14772-1, table
4.5); with one, it would be lit twice. Emitted light is added to the picture; highlights are lost. Transparency becomes
the picture's alpha. Opaque and transparent Shapes use separate pictures, because browsers would blend the opaque ones.

A page of light becomes one combined page, or two if it has transparent Shapes. It is larger by a whole factor, so that
textures keep their detail. If that saves a quarter of the texels, all pages are packed again instead: each chart gets
as many texels as its own texture needs. A chart with even light, such as a wall in shade, gets half as many per side,
or a quarter, down to one texel, as far as `tolerance` allows. Nodes that Shapes without baked light use as well are
copied before they change.

With `budget` or `texels`, more charts are halved, first those that lose least per texel saved. The loss is reported
(light-budget).

With `into=auto`, a Shape that is opaque and has no picture gets colours at its corners (Color) if that is better for
its size in bytes, as for small parts and for faces in full light or shade. The colours are the best fit to the texels.
Error times bytes must be less than `tolerance` times the bytes of the texels, and the error at most twice the
tolerance.

Scenes without lightmaps do not change, which costs O(nodes). Nor do scenes without resources, which hold the pictures.)";
  static constexpr StatisticInfo statistics[] = {
      {"combine-lightmap.shapes", "Shapes whose colour and light are now one texture"},
      {"combine-lightmap.vertex-shapes", "Shapes that have colours at their corners instead"},
      {"combine-lightmap.pages", "pictures made"},
      {"combine-lightmap.texels", "texels of these pictures"},
  };

  TexelFactor scale;
  int max_size = 4096;
  double tolerance = 1;
  SizeOption budget;
  int texels = 0;
  CombineTarget into = CombineTarget::texture;
  CombinedFormat format = CombinedFormat::as_light;

  void fields(auto&& f) {
    f("scale", scale, "texels per texel of the lightmap, along each side; auto: as many as the textures have");
    f("max-size", max_size, "maximum width and height of a picture; a larger lightmap keeps its size",
      between(1, 32768));
    f("tolerance", tolerance,
      "error allowed when a chart gets fewer texels, in 255ths: root mean square; the 99th percentile may be four "
      "times as large",
      between(0, 255));
    f("budget", budget, "maximum size of all pictures together; 0: unlimited");
    f("texels", texels,
      "maximum number of texels of all pictures together; 0: without a budget, 4,194,304 or as many as the lightmaps "
      "have, if that is more",
      at_least(0));
    f("into", into, "where the combined colours go");
    f("format", format, "format of the pictures");
  }
};

Outcome combine_lightmap(Scene&, const CombineLightmapOptions&, PassContext&);

}  // namespace wrlkit

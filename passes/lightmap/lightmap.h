// Pass `lightmap`: its documentation is in its options.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/option_range.h"
#include "geometry/tessellation.h"
#include "light/exposure.h"
#include "light/lamp_fall.h"
#include "light/sky_light.h"
#include "passes/picture_format/picture_format.h"
#include "passes/pipeline/pass.h"
#include "passes/pipeline/time_option.h"
#include "passes/pipeline/written_file.h"

namespace wrlkit {

/// How much work is done.
enum class BakeQuality : std::uint8_t { draft, normal, high };
template <>
inline constexpr auto choices<BakeQuality> = choice_row({{"draft"}, {"normal"}, {"high"}});

/// More or fewer texels for what has a name: "Floor=0.25" or, with an asterisk at the end for any name that begins so,
/// "Sign*=4", several with colons between. The first that fits a Shape counts; Shapes have the names of the groups
/// around them, too.
struct NamedDensities {
  static constexpr std::string_view type = "NAME=FACTOR:NAME*=FACTOR...";
  std::vector<std::pair<std::string, double>> all;
  bool read(std::string_view text);
  std::string print() const;
  /// Of a name; 0: none fits.
  double of(std::string_view name) const;
};

/// What becomes of Shapes without a Material in a scene with lamps.
enum class UnlitSurfaces : std::uint8_t { bake, keep };
template <>
inline constexpr auto choices<UnlitSurfaces> = choice_row({{"bake"}, {"keep"}});

struct LightmapOptions {
  static constexpr std::string_view doc = R"(
Computes the light in the scene and stores it on the surfaces, as textures (Lazanyi, section 3).

    before   PointLight { ... }
             DEF Wall Shape { appearance Appearance { material Material { ... } } geometry Box { ... } }
    after    PointLight { ... }
             DEF Wall Shape { appearance Appearance { material Material { ... }
                                                      lightmap ImageTexture { url "lightmap_0.png" } }
                              geometry IndexedFaceSet { ... lightCoord TextureCoordinate { ... } } }

The surface keeps its colour and texture. For VRML97, which has one texture per Shape, `combine-lightmap` makes one
texture of both. docs/lighting.md describes how light, materials and units are interpreted.

Every surface that a browser would show at the start is lit.

- Each place of a Shape gets light of its own. Shared nodes are copied down to the Shape; geometry stays shared among
  places with the same size and density. Nodes that events can reach are not copied and have the light of their first
  place.
- Geometry becomes an IndexedFaceSet of triangles. If `solid` is FALSE and the surface is open, both sides become faces.
- Further levels of a LOD take the light of the nearest place of the first level. If that is too far away, and with
  `directional`, light is computed while all LODs show that level, or their last one. Each level has half as many texels
  as the one before. LODs within levels are lit at all their levels, one view after the other, with at most 64 views.
- Text becomes faces, unless events, a Script or a prototype may write it.
- Shapes without a Material, which browsers show at full brightness, are lit as well if the scene has lights. Their
  picture or colour becomes what they reflect, and they get a white Material. This is reported (unlit-lit). Shapes that
  move with the viewer, show films or are changed by events are left out. `unlit=keep` leaves all of them unlit.
- Left unchanged: UnlitMaterial, lines, points, and children that a Switch does not show.
- With `patches`, each Shape gets a picture of its own that contains its flat polygons. Of the other options, only
  `smooth` and `format` apply. Only the first level of detail of a Shape is lit.
- What Inlines and prototypes show is lit: `expand` runs first. Shapes whose geometry events change, or contains unknown
  nodes, are not lit. That is reported (not-lit).
- There are at most 2^28 texels in total, and all texels of a Shape are on one page. A high density may therefore be out
  of reach (density-limit).
- `lamps=inverse-square` is for scenes that are dark because radii are small, or evenly lit because attenuations are
  constant. A lamp has the strength that was written at the root mean square distance of the surfaces it shines at, or
  at its radius if that is smaller.
- `exposure=auto` makes the logarithmic mean of the light 0.36: a surface that reflects half of it shows as middle grey.
  The factor is reported (light-exposure), counted (`--stats`) and stored as a line of the WorldInfo, "lightmap exposure
  3.42". Divide lightmapScale by the factor to undo it.
- `budget=60s` chooses the page size and the rays per point that take about that long on this machine, in wall-clock
  time without writing. With `error` it limits the number of rays. The choice is counted (`--stats`) and stored as a
  line of the WorldInfo, "lightmap budget max-size=1024,rays=24"; these options give the same light on every machine.
  Work that does not depend on them, such as charts and levels of detail, takes as long as before.
- A scene without lights, or with too little light, is lit by a white sky. This is reported (no-light).

The pictures need resources to be stored in. Cost: O(texels * rays * log triangles). The result is the same for any
number of threads.)";
  static constexpr StatisticInfo statistics[] = {
      {"lightmap.shapes", "Shapes with baked light"},
      {"lightmap.charts", "pieces of surface on the pages"},
      {"lightmap.pages", "pages (pictures)"},
      {"lightmap.texels", "texels of surface"},
      {"lightmap.samples", "texels that were computed"},
      {"lightmap.rays", "rays that were traced"},
      {"lightmap.inherited", "texels of further levels of detail that take their light from the first level"},
      {"lightmap.inside", "texels inside solids"},
      {"lightmap.leaks", "texels through which light could leak"},
      {"lightmap.black", "texels without light"},
      {"lightmap.holes", "isolated dark texels"},
      {"lightmap.seam-places", "points compared along seams"},
      {"lightmap.jumps", "points along seams where the light jumps"},
      {"lightmap.exposure-thousandths", "factor found by exposure=auto, in thousandths"},
      {"lightmap.page-side", "texels along each side of a page, chosen by budget"},
      {"lightmap.rays-a-point", "rays per point, chosen by budget"},
      {"lightmap.patches", "patches that were drawn"},
      {"lightmap.orphans", "patches without a Shape"},
      {"lightmap.bare-triangles", "triangles without a patch"},
  };

  Tessellation faces{.texcoords = true};
  BakeQuality quality = BakeQuality::normal;
  double error = 0, density = 0;
  int rays = 0;
  TimeOption budget;
  NamedDensities densities;
  int max_size = 0, mips = 0;
  SkyLight sky;
  double emission = 1;
  LampFall lamps = LampFall::as_written;
  Exposure exposure;
  UnlitSurfaces unlit = UnlitSurfaces::bake;
  bool directional = false, exr = false, denoise = true;
  PictureFormat format = PictureFormat::png;
  WrittenFile checkpoint;
  std::string patches;
  bool smooth = false;
  int seed = 1;

  void fields(auto&& f) {
    f("quality", quality, "number of rays and, without density, of texels");
    f("error", error, "relative standard error to reach, such as 0.01; 0: set by quality", between(0, 1));
    f("rays", rays, "rays per point; with error, the maximum; 0: set by quality", between(0, 2048));
    f("budget", budget,
      "time that the bake may take: 60s, 10m; sets the size of pages and the number of rays; 0: set by quality");
    f("density", density, "texels per metre; 0: as many as fit on one page", at_least(0));
    f("densities", densities, "factors on the density, by name");
    f("max-size", max_size, "texels along each side of a page; 0: 512, 1024 or 4096 by quality, 4096 with density",
      between(0, 32768));
    f("mips", mips,
      "number of mip levels in which charts do not mix; 0: up to 4, as many as cost at most a tenth of the texels per "
      "metre",
      between(0, 6));
    f("sky", sky, "light from the sky: that of the Background, none, or a radiance such as 0.5:0.5:1");
    f("emission", emission, "factor for the light of emissiveColor", at_least(0));
    f("lamps", lamps, "how the light of PointLights and SpotLights decreases with distance");
    f("exposure", exposure, "factor for the light; auto: found from the light, and reported");
    f("unlit", unlit,
      "Shapes without a Material, in a scene with lights: bake light onto them, or keep them at full brightness");
    f("directional", directional, "also keep the direction of the light");
    f("exr", exr, "also write the light as OpenEXR");
    f("denoise", denoise, "remove noise");
    f("format", format, "format of the pictures");
    f("checkpoint", checkpoint,
      "file that keeps finished work; the same command continues from it after an interruption");
    f("seed", seed, "seed of the random numbers");
    f("patches", patches, "take the light from this patch file (wrlkit illuminate) instead of computing it");
    f("smooth", smooth, "interpolate the colours of patches");
    faces.fineness_fields(f);
  }
};

Outcome lightmap(Scene& scene, const LightmapOptions& options, PassContext& ctx);

}  // namespace wrlkit

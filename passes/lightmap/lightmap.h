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
Computes the light in the world and puts it onto its surfaces, as textures (Lazanyi, section 3).

    before   PointLight { ... }
             DEF Wall Shape { appearance Appearance { material Material { ... } } geometry Box { ... } }
    after    PointLight { ... }
             DEF Wall Shape { appearance Appearance { material Material { ... }
                                                      lightmap ImageTexture { url "lightmap_0.png" } }
                              geometry IndexedFaceSet { ... lightCoord TextureCoordinate { ... } } }

The surface keeps its own colour and texture; what VRML97 can say, one texture, is made of both by `combine-lightmap`.

Lights every surface that a browser would show, as it stands at the start.

- The world as light sees it, in which units, is in docs/lighting.md.
- Each place of a Shape gets light of its own: what is shared by USE is copied down to the Shape, geometry stays
  shared among those that show it in one size and density. What events can reach is not copied: it has the light of
  its first place.
- Geometry becomes an IndexedFaceSet of triangles. Where `solid` is FALSE and the surface is open, both sides get
  faces.
- Further levels of a LOD have the light of the nearest place of the first one. Where that is far away, and with
  `directional`, it is computed, where all LODs show that level, or their last. Half the texels a level. LODs within
  levels have light at all of theirs, too: as many views are lit as there are levels one behind the
  other, 64 at the most.
- Text becomes faces, too, unless events, a Script or a prototype may write it.
- Shapes without a Material, which browsers show at full brightness, get light, too, where the world has lamps: their
  picture or colour is what they reflect, and they get a white Material. That is reported (unlit-lit). Not those that
  hang before the viewer, show films or are changed by events; `unlit=keep` leaves all as they are.
- Left alone: UnlitMaterial, lines, points, other choices of a Switch.
- With `patches` each Shape gets a picture of its own, in which its flat polygons lie; of the other options only
  `smooth` and `format` count. Shapes show their first level of detail only; further ones stay without light.
- What stands behind Inline or in prototypes is not looked into: run `expand` before. Nor is a Shape whose geometry
  events change or contains unknown nodes. All that is reported (not-lit).
- There are at most 2^28 texels in all, and a Shape's fit on a page; so a great density may be out of reach
  (density-limit).
- `lamps=inverse-square` is for worlds that are dark because radii and attenuations are small, or that are lit evenly as
  those are large: the lamp is as strong as it was written at the root mean square distance of what it shines at, or at
  its radius if that is less.
- `exposure=auto` brings the logarithmic mean of the light to 0.36, so that what reflects a half of it shows as middle
  grey. The factor is reported (light-exposure), counted (`--stats`) and kept as a line of the WorldInfo,
  "lightmap exposure 3.42". Dividing lightmapScale by it undoes it.
- `budget=60s` chooses the size of pages and the rays a point that take about that long on this machine, writing not
  counted: the time of a clock, as somebody waits for it. With `error` it is a limit to the rays. What was chosen is
  counted (`--stats`) and kept as a line of the WorldInfo, "lightmap budget max-size=1024,rays=24": with these options
  instead the light is the same on every machine. It makes nothing faster that has to be done anyway: charts, levels of
  detail.
- A world without any light, or with too little to see it by, is lit by a white sky, which is reported (no-light).

Needs resources, which take the pictures. O(texels * rays * log triangles). The same result for any number of
threads.)";
  static constexpr StatisticInfo statistics[] = {
      {"lightmap.shapes", "Shapes that have light"},
      {"lightmap.charts", "pieces of surface on the pages"},
      {"lightmap.pages", "pictures"},
      {"lightmap.texels", "texels of surface"},
      {"lightmap.samples", "texels that were computed"},
      {"lightmap.rays", "rays that were traced"},
      {"lightmap.inherited", "texels of further levels of detail that have the light of the first one"},
      {"lightmap.inside", "texels inside of something solid"},
      {"lightmap.leaks", "texels through which light could leak"},
      {"lightmap.black", "texels without any light"},
      {"lightmap.holes", "specks of dark texels"},
      {"lightmap.seam-places", "places along seams that were compared"},
      {"lightmap.jumps", "those where the light jumps"},
      {"lightmap.exposure-thousandths", "factor on the light, by exposure=auto"},
      {"lightmap.page-side", "texels along each side of a page, by budget"},
      {"lightmap.rays-a-point", "rays of a point, by budget"},
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

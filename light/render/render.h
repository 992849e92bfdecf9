// A picture of a scene as a VRML browser shows it: the lighting model of ISO/IEC 14772-1, 4.14, in the colours of the
// display, ray traced through Embree so that it needs no window, no driver and no graphics card.
//
// The scene is an expanded one (no prototypes, no Inlines). Of Switch it shows what shown_children() says, of LOD the
// level that is asked for, and Billboards turn to the viewer. There are no shadows: VRML has none. The same scene gives
// the same bytes on any number of threads.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/choice.h"
#include "base/diagnostics.h"
#include "geometry/mesh.h"
#include "light/exposure.h"
#include "light/lamp_fall.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// The red end of Mode::density; the colours before it, evenly in the logarithm: yellow, green, cyan, and blue for 1.
inline constexpr double most_texels_per_metre = 1024;

struct LookAt {
  Vec3 eye{0, 0, 10}, target{0, 0, 0}, up{0, 1, 0};
};

struct RenderOptions {
  /// preview: what a browser shows, and baked light where there is some. wireframe: grey surfaces with the edges of
  /// their triangles, hidden lines removed. lightmap: the baked light alone. checker: its texels, alternately dark and
  /// light. density: texels a metre, from blue (1) by green (32) to red (1024). albedo: surfaces without any light.
  /// path: with shadows and reflected light, by path tracing (light/path_picture.h); noise falls with `samples`,
  /// the headlight is off, and there are no lines and points.
  enum class Mode : std::uint8_t { preview, wireframe, lightmap, checker, density, albedo, path };

  int width = 1280, height = 960;
  int samples =
      4;  // rays along each side of a pixel where the picture changes, at most 16; path: everywhere, at most 64
  Mode mode = Mode::preview;

  // From where: `look_at`, else `fit`, else the Viewpoint of that name or description, else the first Viewpoint of the
  // world, else as with `fit`: all of the world, from the front, the right and above.
  std::optional<LookAt> look_at;
  bool fit = false;
  std::string viewpoint;
  double field_of_view = 0;  // radians, of the shorter side of the picture; 0: the Viewpoint's, or 0.785398

  // Of each LOD that level, from 0, or its last; none: by the distance of the viewer (6.26). Where the picture is taken
  // from does not depend on it: `fit` looks at the first levels.
  std::optional<std::size_t> level = 0;
  std::optional<Vec3> background;         // instead of the world's Background
  std::optional<bool> headlight;          // instead of what NavigationInfo says
  LampFall lamps = LampFall::as_written;  // path
  Exposure exposure;                      // path: of all of the picture; auto: found from it, and reported
  std::function<void(double)> done;       // path: told now and then how much of the picture is there, up to 1
};
template <>
inline constexpr auto choices<RenderOptions::Mode> =
    choice_row({{"preview", "as in a browser"},
                {"wireframe"},
                {"lightmap", "only the light of lightmaps"},
                {"checker", "texels of lightmaps as a checkerboard"},
                {"density", "texels of lightmaps per metre"},
                {"albedo", "colours without light"},
                {"path", "path tracing, with shadows and reflected light; noise falls with --samples"}});

/// Draws the scene. `resources` gives the pictures of textures; without it, or where one cannot be read, the material
/// shows. The picture is RGB and always there: an empty scene gives its background.
Image render(const Scene& scene, const MeshSource& meshes, const RenderOptions& options, Resources* resources,
             Diagnostics& diag);

/// The options with the camera that render() would take for this scene spelled out: for pictures of other scenes from
/// the same place.
RenderOptions with_camera(const Scene& scene, const MeshSource& meshes, const RenderOptions& options,
                          Diagnostics& diag);

/// The options for `n` pictures around the world: the camera goes once around the vertical through the middle of it, to
/// the right first. Without `look_at` and `viewpoint` it sees all of the world from each side, from above.
std::vector<RenderOptions> turntable(const Scene& scene, const MeshSource& meshes, RenderOptions options, int n,
                                     Diagnostics& diag);

}  // namespace wrlkit

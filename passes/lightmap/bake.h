// Light for every texel of every page: points of the surface are lit, noise is taken out, cuts are closed, gaps are
// filled.
#pragma once
#include <string>
#include <vector>

#include "light/exposure.h"
#include "light/integrator.h"
#include "passes/lightmap/darkness.h"
#include "passes/lightmap/layout.h"

namespace wrlkit::bake {

class FinestLight;

struct BakeOptions {
  int samples = 4;                      // points a texel
  int rays = 16;                        // a point, even; where an error is asked for, for a start
  light::IntegratorOptions integrator;  // its rays tell how good the cache must be
  int most_rays = 2048;                 // a point, where an error is asked for
  double error = 0;  // relative standard error that is wanted of what is shown, after denoising; 0: none
  bool directional = false;
  bool denoise = true;
  std::string title = "lightmap";       // for the Monitor
  const FinestLight* finest = nullptr;  // light of the first levels of detail, for those behind them; null: none
  std::string checkpoint;               // file in which finished tiles are kept, and stay; empty: none
};

/// Pictures of a page, linear, row 0 the lowest.
struct BakedPage {
  Canvas light;                   // irradiance / pi
  std::vector<Canvas> direction;  // mean direction of the light: X, Y and Z, each from -1 to 1 for red, green and blue
  std::size_t n_texels = 0;       // that lie on faces
  std::vector<DarkUse> dark;
  light::LightMeter meter;  // of texels that have light of their own
};

/// One for each page of the layout. `world` must have been made of the stage that the layout's uses refer to.
/// Statistics: lightmap.texels (covered), .samples, .rays, .inherited (those that
/// have the light of a finer level instead), .inside (texels whose points lie within something, filled
/// from their neighbours), .leaks (those of them on which a lamp shines, or a surface outside, though backs are all
/// around), .black (texels in the open that no light reaches), .holes (those of them amid lit ones), .seam-places and
/// .jumps (SeamReport). The same for any number of threads, and after an interruption.
std::vector<BakedPage> bake(const std::vector<Part>& parts, const Layout& layout, const light::LightWorld& world,
                            const BakeOptions& options, PassContext& ctx);

}  // namespace wrlkit::bake

// A picture by path tracing: with shadows and reflected light, which the lighting model of VRML does not have.
#pragma once
#include <functional>
#include <optional>

#include "base/diagnostics.h"
#include "geometry/mesh.h"
#include "light/color.h"
#include "light/exposure.h"
#include "light/lamp_fall.h"
#include "light/render/camera.h"
#include "light/render/stage.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit::light {

struct PathOptions {
  int samples = 4;  // paths along each side of a pixel
  LampFall lamps = LampFall::as_written;
  Exposure exposure;
  std::optional<V3> background;      // linear; seen instead of the Background, which lights the world all the same
  drawing::LevelOf level_of;         // of LODs; may be empty
  std::function<void(double)> done;  // told now and then how much of the picture is there, up to 1; may be empty
};

/// What the world's own lights, emissive surfaces and Background make of it (LightWorld), without a headlight, averaged
/// in linear light and shown through the sRGB curve, cut at 1. What is behind something transparent is mixed with it as
/// it is displayed, as browsers do. The backs of `solid` faces are seen through. Lines and
/// points are not there, which is reported, as is a scene without light. The same bytes for any number of threads.
/// O(pixels * samples^2
/// * reflections) rays.
Image path_picture(const Scene& scene, const MeshSource& source, const drawing::Camera& camera,
                   const PathOptions& options, Resources* resources, Diagnostics& diag);

}  // namespace wrlkit::light

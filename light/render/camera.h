// Where a picture is taken from and which ray belongs to which place in it.
#pragma once
#include "light/render/linear.h"
#include "light/render/stage.h"

namespace wrlkit::drawing {

/// A perspective camera. Places in the picture are in pixels, from the upper left corner.
struct Camera {
  V3 eye;
  V3 right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};  // unit, at right angles
  int width = 1, height = 1;
  double half_x = 1, half_y = 1;  // tangents of half the horizontal and vertical field of view
  double sample_span = 0.5;       // pixels between neighbouring samples, for textures

  /// Unit direction of the ray through a place.
  V3 direction(double px, double py) const {
    return unit((half_x * (2 * px / width - 1)) * right + (half_y * (1 - 2 * py / height)) * up - back);
  }
  /// Where a point appears: (x w, y w, w); w is its distance along the view, negative behind the camera.
  V3 project(const V3& p) const {
    V3 q = p - eye;
    double w = -dot(q, back);
    return {0.5 * width * (w + dot(q, right) / half_x), 0.5 * height * (w - dot(q, up) / half_y), w};
  }
  /// What a pixel in the middle of the picture spans at distance 1.
  double pixel() const { return 2 * half_y / height; }
  /// The same of a sample.
  double sample() const { return pixel() * sample_span; }
  Pose pose() const { return {eye, up}; }
};

struct Lens {
  int width = 1280, height = 960;
  double field_of_view = 0.785398;  // of the shorter side (6.53)
};

/// The camera that looks along -Z of a frame, from its origin, with Y up. Scale and shear of the frame do not count.
Camera camera_in(const Affine& frame, const Lens& lens);
/// From an eye to a target. When they coincide it looks along -Z; when `up` is the line of sight another one is taken.
Camera camera_at(const V3& eye, const V3& target, const V3& up, const Lens& lens);
/// Shows the whole box, in the middle and with a margin of 5 %: from the front, the right and above, or straight from
/// the front when it has no depth.
Camera camera_on(const Box& box, const Lens& lens);

}  // namespace wrlkit::drawing

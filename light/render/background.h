// What is seen where nothing is: Background (ISO/IEC 14772-1, 6.5) or TextureBackground (ISO/IEC 19775-1, 24.4.6),
// infinitely far away.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "light/render/stage.h"
#include "light/render/texture.h"
#include "scenegraph/resources.h"

namespace wrlkit::drawing {

class Sky {
 public:
  /// One colour everywhere.
  explicit Sky(const V3& color) { sky_.push_back({0, color}); }
  /// A Background or TextureBackground in its frame, of which only the rotation counts.
  Sky(const Scene& scene, NodeId background, const Affine& frame, Resources* resources, Diagnostics& diag);

  /// The colour in a direction of the world. `spread` is the angle that a sample spans.
  V3 color(const V3& direction, double spread) const;

 private:
  struct Band {
    double angle;
    V3 color;
  };
  /// A picture on the cube: seen in direction `out`, its right side in direction `right`, its upper one in `up`.
  struct Face {
    V3 out, right, up;
    std::shared_ptr<const Texture> picture;
  };
  using Colors = FieldKey<FieldType::MFColor>;
  using Angles = FieldKey<FieldType::MFFloat>;

  void set_bands(const Scene& scene, NodeId n, Colors sky, Angles sky_angles, Colors ground, Angles ground_angles);
  static std::vector<Band> bands(std::span<const double> colors, std::span<const double> angles);
  static V3 between(const std::vector<Band>& bands, double angle);
  V3 sphere(const V3& d) const;

  Affine to_local_;
  std::vector<Band> sky_, ground_;
  std::vector<Face> faces_;
};

}  // namespace wrlkit::drawing

// What a part of a plant is, by parameters: a pipe is an axis, a radius and a height, whatever the triangles that some
// exporter made of it. `recognise` (geometry/recognise/) finds forms in meshes, `tessellate` and the world levels cut
// them again, as finely as they need to be.
//
// Every form has a frame of its own, with the axis Y: cylinders, frusta, rings, prisms, boxes and pyramids are
// centred on the origin, a sphere has its poles on Y, a dish has its rim in y = 0 and its pole at +Y, and tori bend
// around Y from +X towards -Z. Around Y, the first point of a polygon is at -Z, as in VRML97. Lengths in the unit of
// the mesh, angles in radians.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "base/math/matrix.h"
#include "geometry/mesh.h"

namespace wrlkit {

struct CylinderForm {
  double radius = 1, height = 2;
};

/// Cones and reducers, concentric or not, and pipes whose ends are cut at a slant. Of a cone one radius is 0.
struct FrustumForm {
  double bottom_radius = 1, top_radius = 0, height = 2;
  Vec2 offset{};                     // from the middle of the bottom to that of the top, along X and Z
  Vec2 bottom_slope{}, top_slope{};  // how an end rises along X and Z

  /// Both ends are square to the axis and around it.
  bool is_straight() const { return offset == Vec2{} && bottom_slope == Vec2{} && top_slope == Vec2{}; }
};

/// An elbow, or a whole ring of round section.
struct TorusForm {
  double bend_radius = 2, radius = 1, angle = 1.5707963267948966;
  double turn = 0;  // where on the section the first point is: 0 farthest from the axis, then towards +Y
};

/// A rectangle that is turned around Y.
struct RectangularTorusForm {
  double inner_radius = 1, outer_radius = 2, height = 1, angle = 1.5707963267948966;
};

struct SphereForm {
  double radius = 1;
};

/// A dished head: half an ellipsoid of revolution, or the cap of a sphere, which may be more than half of it.
struct DishForm {
  double radius = 1, height = 0.5;
  bool spherical = false;
};

struct BoxForm {
  Vec3 size{2, 2, 2};
};

/// Between two rectangles (along X and Z) in parallel planes. One of them may be a line or a point.
struct PyramidForm {
  Vec2 bottom{2, 2}, top{};
  double height = 2;
  Vec2 offset{};  // from the middle of the bottom to that of the top
};

/// A polygon with or without holes, in X and Z, extruded along Y.
struct PrismForm {
  std::vector<Vec2> points;              // of all rings
  std::vector<std::uint32_t> ring_ends;  // behind the last point of each; the first is the outer one
  double height = 1;
  double crease_angle = 0;  // edges between walls that are flatter are smooth
};

/// A pipe with a wall, a flange, a washer.
struct RingForm {
  double inner_radius = 0.5, outer_radius = 1, height = 1;
};

struct Form {
  using Shape = std::variant<CylinderForm, FrustumForm, TorusForm, RectangularTorusForm, SphereForm, DishForm, BoxForm,
                             PyramidForm, PrismForm, RingForm>;
  Shape shape;
  Matrix frame;                    // from its own frame to that of the mesh; a rotation and a translation
  bool bottom = true, top = true;  // whether it is closed at -Y and +Y (a dish: at its rim); a torus: at 0 and `angle`
  int segments = 0;  // around, as the part showed them; of a rectangular torus along the bend; 0: no round form
  int rings = 0;     // of a torus along the bend; of a dish from rim to pole; of a sphere from pole to pole
};

/// "cylinder", "cone" (one radius is 0), "frustum", "torus", "rectangular-torus", "sphere", "dish", "box", "pyramid",
/// "prism", "ring".
std::string_view kind_of(const Form& form);

/// How finely a form is cut.
struct FormCut {
  int segments = 0, rings = 0;  // 0: as the form has them
  /// Polygons as large as the circles that they replace, instead of within them: what keeps a pipe of five sides as
  /// near as it can be.
  bool equal_area = false;
};

/// The largest of its radii; 0 of one that is not round.
double reach_of(const Form& form);

/// The fewest segments and rings whose chords stay within `tolerance` of the form, at least three around.
FormCut cut_within(const Form& form, double tolerance);

/// The faces: quadrilaterals and whole caps, with normals that are smooth along round walls and sharp at rims. With the
/// segments and rings that a part showed these are its own points. The mesh is cleared first.
void tessellate_form(const Form& form, const FormCut& cut, Mesh& mesh);

/// The number for the faces that tessellate_form makes, when they are cut. O(1).
std::size_t n_triangles(const Form& form, const FormCut& cut);

/// An end of a form where another may go on: a circle and where its first point is.
struct FormEnd {
  Vec3 centre{}, axis{}, first{};  // axis: unit length, out of the form; first: a direction, unit length
  double radius = 0;
  bool top = false;  // which of the two; closed if Form::top or bottom is
};

/// Round ends: two of a cylinder, a frustum without slant, an elbow; one of a dish; of a ring the outer circles.
/// None of others.
std::vector<FormEnd> round_ends(const Form& form);

}  // namespace wrlkit

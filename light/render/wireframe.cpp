#include "light/render/wireframe.h"

#include <algorithm>

namespace wrlkit::drawing {
namespace {

constexpr double half_width = 0.5;  // of an edge, pixels; the triangle on its other side draws the other half
constexpr double crowded = 6;       // triangles less high than this many pixels have paler edges, or all would be black
const V3 sheet{0.9}, pen{0.12};

}  // namespace

V3 Wireframe::color(double px, double py) const {
  Ray ray{camera_.eye, camera_.direction(px, py)};
  Hit hit;
  if (!tracer_.nearest(ray, 0, hit)) return background_;
  if (drawing_.meshes[drawing_.mesh_of[hit.use]].kind != Mesh::Kind::faces) return pen;
  V3 lit = (0.5 + 0.5 * std::fabs(dot(spot_at(drawing_, ray, hit).normal, ray.direction))) * sheet;
  return mix(lit, pen, ink(hit, px, py));
}

/// How much of the pen is at a place of a triangle: distances are measured in the picture. Corners and edges are taken
/// as homogeneous points and lines, which are right behind the camera, too.
double Wireframe::ink(const Hit& hit, double px, double py) const {
  const PooledMesh& m = drawing_.meshes[drawing_.mesh_of[hit.use]];
  const Affine& frame = drawing_.stage.frames[drawing_.stage.uses[hit.use].frame];
  V3 corner[3];
  for (int k = 0; k < 3; ++k)
    corner[k] = camera_.project(frame.point(drawing_.meshes.position(m, hit.element, k) + m.origin));
  double nearest = 1e9, lowest = 1e9;
  for (int k = 0; k < 3; ++k) {
    V3 line = cross(corner[(k + 1) % 3], corner[(k + 2) % 3]);
    double scale = std::hypot(line.x, line.y);
    nearest = std::min(nearest, std::fabs(line.x * px + line.y * py + line.z) / scale);
    lowest = std::min(lowest, std::fabs(dot(line, corner[k]) / corner[k].z) / scale);
  }
  return nearest < half_width ? std::min(1.0, lowest / crowded) : 0;
}

}  // namespace wrlkit::drawing

#include "passes/lower_x3d/sphere_segment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

/// Finite ones, in radians.
std::vector<double> lines_of(const std::vector<double>& degrees) {
  std::vector<double> out;
  for (const double d : degrees)
    if (std::isfinite(d) && out.size() < SphereNet::most_lines) out.push_back(d * std::numbers::pi / 180);
  return out;
}

std::vector<std::int32_t> quadrilaterals(std::size_t columns, std::size_t rows) {
  std::vector<std::int32_t> index;
  for (std::size_t j = 0; j + 1 < rows; ++j)
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const auto first = static_cast<std::int32_t>(j * columns + i), above = first + static_cast<std::int32_t>(columns);
      index.insert(index.end(), {first, above, above + 1, first + 1, -1});
    }
  return index;
}

}  // namespace

NodeId faces_of(Scene& scene, const SphereNet& net, Span where) {
  const auto longitude = lines_of(net.longitude), latitude = lines_of(net.latitude);
  if (longitude.size() < 2 || latitude.size() < 2) return {};
  std::vector<double> points, normals, places;
  for (std::size_t j = 0; j < latitude.size(); ++j)
    for (std::size_t i = 0; i < longitude.size(); ++i) {
      const double c = std::cos(latitude[j]);
      for (const double v : {-c * std::cos(longitude[i]), std::sin(latitude[j]), -c * std::sin(longitude[i])}) {
        normals.push_back(v);
        points.push_back(net.radius * v);
      }
      places.push_back(static_cast<double>(i) / static_cast<double>(longitude.size() - 1));
      places.push_back(static_cast<double>(j) / static_cast<double>(latitude.size() - 1));
    }
  namespace f = nodes::indexed_face_set;
  const NodeId to = scene.add(nodes::IndexedFaceSet, where), coord = scene.add(nodes::Coordinate, where),
               normal = scene.add(nodes::Normal, where), texture = scene.add(nodes::TextureCoordinate, where);
  scene.set(coord, nodes::coordinate::point, points);
  scene.set(normal, nodes::normal::vector, normals);
  scene.set(texture, nodes::texture_coordinate::point, places);
  scene.set(to, f::coord, coord, f::normal, normal, f::texCoord, texture, f::coordIndex,
            quadrilaterals(longitude.size(), latitude.size()));
  return to;
}

}  // namespace wrlkit::x3d

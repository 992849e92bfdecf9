#include "parsers/patches/patches_scene.h"

#include <algorithm>
#include <cmath>

#include "base/image/srgb.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

struct Faces {
  std::vector<double> points, colors;
  std::vector<std::int32_t> indices;

  void add(const Patch& p) {
    const auto first = static_cast<std::int32_t>(points.size() / 3);
    for (std::size_t k : {0, 1, 2}) {
      const auto& corner = p.corners[p.back ? 2 - k : k];
      points.insert(points.end(), corner.begin(), corner.end());
      indices.push_back(first + static_cast<std::int32_t>(k));
    }
    indices.push_back(-1);
    for (float c : p.rgb) colors.push_back(linear_to_srgb(c));
  }
};

NodeId face_set(Scene& scene, const Faces& faces) {
  namespace f = nodes::indexed_face_set;
  const NodeId coord = scene.add(nodes::Coordinate), color = scene.add(nodes::Color),
               set = scene.add(nodes::IndexedFaceSet);
  scene.set(coord, nodes::coordinate::point, faces.points);
  scene.set(color, nodes::color::color, faces.colors);
  scene.set(set, f::coord, coord, f::color, color, f::colorPerVertex, false, f::coordIndex, faces.indices);
  return set;
}

}  // namespace

void add_patches(const PatchSet& set, Scene& scene) {
  for (std::size_t s = 0; s < set.shapes.size(); ++s) {
    Faces faces;
    for (auto t = set.shapes[s].first_triangle; t < set.end_of_shape(s); ++t)
      for (const auto& p : set.patches_of(t)) faces.add(p);
    if (faces.indices.empty()) continue;
    const NodeId shape = scene.add(nodes::Shape);
    scene.set(shape, nodes::shape::geometry, face_set(scene, faces));
    scene.main.roots.push_back(shape);
  }
}

}  // namespace wrlkit

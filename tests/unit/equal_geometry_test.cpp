// Geometry that says the same, and long arrays that differ in one number only.
#include "geometry/equal_geometry.h"

#include <catch2/catch.hpp>
#include <vector>

#include "scenegraph/nodes.h"

using namespace wrlkit;

namespace {

NodeId face_set(Scene& scene, std::size_t changed) {
  constexpr std::size_t n_points = 20'000;
  std::vector<double> points;
  for (std::size_t i = 0; i < n_points; ++i) points.insert(points.end(), {double(i), i == changed ? 1.0 : 0.0, 0.0});
  const NodeId coord = scene.add(nodes::Coordinate), faces = scene.add(nodes::IndexedFaceSet);
  scene.set(coord, nodes::coordinate::point, points);
  scene.set(faces, nodes::indexed_face_set::coord, coord);
  return faces;
}

}  // namespace

TEST_CASE("equal geometry: long arrays are compared in full, though only pieces of them are hashed") {
  constexpr std::size_t none = -1;
  Scene scene;
  const NodeId first = face_set(scene, none), like_it = face_set(scene, none);
  EqualGeometry equal(scene);
  CHECK_FALSE(equal.find(first));
  equal.add(first);
  CHECK(equal.find(like_it) == first);
  int same_hashes = 0;
  for (std::size_t i = 7000; i < 7200; i += 20) {
    const NodeId other = face_set(scene, i);
    same_hashes += EqualGeometry::hash_of(scene, other) == EqualGeometry::hash_of(scene, first);
    CHECK_FALSE(equal.find(other));
  }
  CHECK(same_hashes > 0);
}

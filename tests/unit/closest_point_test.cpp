// The nearest point among triangles that have labels.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "geometry/closest_point.h"
#include "geometry/simplify/pieces.h"
#include "geometry/simplify/surfaces.h"
#include "test_world.h"

using namespace wrlkit;
using namespace wrlkit::simplify;

namespace {

Mesh box() {
  TestWorld w("Shape { geometry Box { size 2 2 2 } }");
  Mesh mesh;
  SurfaceReader(w.scene, w.ctx).read(surfaces_of(w.scene)[0], mesh);
  return mesh;
}

}  // namespace

TEST_CASE("nearest point: only labels that count", "[levels]") {
  Mesh two = box();
  const std::size_t n = two.n_faces();
  Mesh other = box();
  transform(other, translation_matrix({10, 0, 0}));
  append(two, other);
  std::vector<std::uint32_t> labels(2 * n);
  std::fill(labels.begin() + static_cast<std::ptrdiff_t>(n), labels.end(), 1u);
  const ClosestPoint tree(triangles_of(two), labels);
  const double far = std::numeric_limits<double>::infinity();
  CHECK(tree.nearest_of({1.5, 0, 0}, far, {}).distance == Approx(0.5));
  CHECK(tree.nearest_of({1.5, 0, 0}, far, {0, 1}).distance == Approx(7.5));
  CHECK(std::isinf(tree.nearest_of({1.5, 0, 0}, 7, {0, 1}).distance));
  CHECK(std::isinf(tree.nearest_of({1.5, 0, 0}, far, {0, 2}).distance));
}

TEST_CASE("nearest point: what is forgotten is not found again", "[levels]") {
  Mesh row;
  std::vector<std::uint32_t> labels;
  for (std::uint32_t i = 0; i < 50; ++i) {
    Mesh next = box();
    transform(next, translation_matrix({3. * i, 0, 0}));
    if (i == 0)
      row = next;
    else
      append(row, next);
    labels.insert(labels.end(), next.n_faces(), i);
  }
  ClosestPoint tree(triangles_of(row), labels);
  const double far = std::numeric_limits<double>::infinity();
  const Vec3 p{76, 0, 0};
  for (std::uint32_t i = 0; i < 24; ++i) {
    CHECK(tree.nearest_of(p, far, {}).distance == Approx(3. * i).margin(1e-12));
    tree.forget(25 - i, 26 - i);
    CHECK(tree.nearest_of(p, far, {}).distance == Approx(3. * i + 1));
    tree.forget(26 + i, 27 + i);
  }
  tree.forget(0, 50);
  CHECK(std::isinf(tree.nearest_of(p, far, {}).distance));
}

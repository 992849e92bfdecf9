// Every affine matrix can be expressed by one Transform.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "passes/lower_vrml1/placement.h"
#include "scenegraph/decompose.h"

using namespace wrlkit;
using namespace wrlkit::vrml1;

namespace {

double difference(const Matrix& a, const Matrix& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.m.size(); ++i) most = std::max(most, std::abs(a.m[i] - b.m[i]));
  return most;
}

Matrix random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-3, 3);
  Matrix m;
  for (double& v : m.m) v = number(random);
  return m;
}

}  // namespace

TEST_CASE("decompose: any matrix, mirrored ones too", "[vrml1]") {
  std::mt19937 random(97);
  for (int i = 0; i < 10'000; ++i) {
    const Matrix m = random_matrix(random);
    REQUIRE(difference(matrix_of(decompose(m)), m) < 1e-9);
  }
}

TEST_CASE("decompose: flat matrices keep what is left of them", "[vrml1]") {
  std::mt19937 random(98);
  for (int i = 0; i < 1000; ++i) {
    const Matrix m = random_matrix(random) * scale_matrix({1, 1, 0});
    REQUIRE(difference(matrix_of(decompose(m)), m) < 1e-6);
  }
  for (int i = 0; i < 1000; ++i) {
    const Matrix m = random_matrix(random) * scale_matrix({0, 1, 0}) * rotation_matrix({1, 2, 3, 0.1 * i});
    REQUIRE(difference(matrix_of(decompose(m)), m) < 1e-6);  // to a line
  }
  for (double v : matrix_of(decompose(scale_matrix({0, 0, 0}))).m) CHECK(v == 0);
}

TEST_CASE("decompose: half a turn about any axis", "[vrml1]") {
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0.6, 0.8, 0}, Vec3{-0.6, 0, 0.8}}) {
    const Matrix m = rotation_matrix({axis[0], axis[1], axis[2], 3.141592653589793});
    CHECK(difference(matrix_of(decompose(m)), m) < 1e-9);
  }
}

TEST_CASE("decompose: numbers that are none are left out", "[vrml1]") {
  Matrix m;
  m(0, 0) = std::nan("");
  CHECK(decompose(m) == TransformFields{});
}

TEST_CASE("placement: fields and matrix agree, whatever is added", "[vrml1]") {
  std::mt19937 random(99);
  std::uniform_real_distribution<double> number(-2, 2);
  std::uniform_int_distribution<int> kind(0, 4);
  for (int i = 0; i < 3000; ++i) {
    Placement p;
    for (int k = 0; k < 4; ++k) {
      const Vec3 v{number(random), number(random), number(random)};
      const Vec4 r{0.6, 0, 0.8, number(random)};
      switch (kind(random)) {
        case 0:
          p.then(TransformFields{.translation = v});
          break;
        case 1:
          p.then(TransformFields{.rotation = r});
          break;
        case 2:
          p.then(TransformFields{.scale = v});
          break;
        case 3:
          p.then(TransformFields{.translation = v, .rotation = r, .center = {v[1], v[2], v[0]}});
          break;
        default:
          p.then(translation_matrix(v));
          break;
      }
      REQUIRE(difference(matrix_of(p.fields()), p.matrix()) < 1e-8);
    }
  }
}

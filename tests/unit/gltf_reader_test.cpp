// Parts of the glTF reader: JSON with places, matrices as Transforms, polygons out of triangles.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/image/srgb.h"
#include "base/math/affine.h"
#include "base/math/digits.h"
#include "parsers/gltf/accessors.h"
#include "parsers/gltf/context.h"
#include "parsers/gltf/polygons.h"
#include "parsers/gltf/trs.h"

using namespace wrlkit;
using namespace wrlkit::gltf_reader;

namespace {

Matrix random_matrix(std::mt19937& random, int rank) {
  std::uniform_real_distribution<double> number(-3, 3);
  Matrix m;
  for (double& v : m.m) v = number(random);
  for (int r = 0; r < 3; ++r) {
    if (rank < 3) m(r, 2) = m(r, 0) * 2 - m(r, 1);
    if (rank < 2) {
      m(r, 1) = -m(r, 0);
      m(r, 2) = 3 * m(r, 0);
    }
    if (rank < 1) m(r, 0) = m(r, 1) = m(r, 2) = 0;
  }
  return m;
}

}  // namespace

TEST_CASE("JSON knows where its values stand", "[gltf-reader]") {
  JsonDocument doc;
  const std::string text = R"({"a": [1, -2.5e1, true, null, "x\"\u00e9\ud83d\ude00"], "b": {"c": 3}})";
  CHECK_FALSE(doc.parse(text));
  const Json root = doc.root();
  auto a = root["a"].elements();
  REQUIRE(a.size() == 5);
  CHECK(a[1].number() == -25);
  CHECK(a[1].offset() == text.find("-2.5"));
  CHECK(a[2].boolean());
  CHECK(a[4].text() == "x\"é😀");
  CHECK(root["b"]["c"].whole() == 3);
  CHECK(root["b"].source() == R"({"c": 3})");
  CHECK_FALSE(root["none"]["of"]["these"]);
}

TEST_CASE("JSON keeps what stands before a fault", "[gltf-reader]") {
  for (std::string_view text : {R"({"a": 1, "b": )", R"({"a": 1 "b": 2})", R"({"a": 1, b: 2})", R"({"a": 1, "b": 01x})",
                                "{\"a\": 1, \"b\": \"", R"({"a": 1}})"}) {
    JsonDocument doc;
    CHECK(doc.parse(text));
    CHECK(doc.root()["a"].number() == 1);
  }
  JsonDocument deep;
  CHECK(deep.parse(std::string(100'000, '[')));
  JsonDocument empty;
  CHECK(empty.parse(""));
  CHECK_FALSE(empty.root());
}

TEST_CASE("A Transform says every matrix", "[gltf-reader]") {
  std::mt19937 random(5);
  for (int rank : {3, 3, 3, 2, 1, 0})
    for (int i = 0; i < 50; ++i) {
      const Matrix m = random_matrix(random, rank), again = matrix_of(place_of(m));
      for (std::size_t k = 0; k < 12; ++k) CHECK(again.m[k] == Approx(m.m[k]).margin(1e-7));
      if (rank < 3) continue;
      const Matrix one = inverse(m) * m;
      for (std::size_t k = 0; k < 12; ++k) CHECK(one.m[k] == Approx(Matrix().m[k]).margin(1e-7));
    }
}

TEST_CASE("Floats become the numbers that they were printed as", "[gltf-reader]") {
  for (double d : {0.1, -0.3, 1e-9, 123456.7, 3.14159, 16777216.0, 0.0}) CHECK(decimal(static_cast<float>(d)) == d);
  for (double d : {0.0, 0.1, 0.2, 0.5, 0.75, 0.8, 1.0}) CHECK(display(static_cast<float>(srgb_to_linear(d))) == d);
}

TEST_CASE("Triangles of one polygon are that polygon again", "[gltf-reader]") {
  const std::uint32_t quad_and_more[] = {0, 1, 2, 0, 2, 3, 3, 2, 4};
  const double runs[] = {2, 1, 1, 1};
  auto p = polygons_of(quad_and_more, runs);
  CHECK(p.corners == std::vector<std::uint32_t>{0, 1, 2, 3, 3, 2, 4});
  CHECK(p.begin == std::vector<std::uint32_t>{0, 4, 7});
  SECTION("an L, whose first triangle does not begin at its outline's end") {
    const std::uint32_t l[] = {1, 2, 3, 0, 1, 3, 0, 3, 5, 3, 4, 5};
    const double one[] = {4, 1};
    CHECK(polygons_of(l, one).corners == std::vector<std::uint32_t>{1, 2, 3, 4, 5, 0});
  }
  SECTION("two triangles that do not touch stay two") {
    const std::uint32_t apart[] = {0, 1, 2, 3, 4, 5};
    const double one[] = {2, 1};
    CHECK(polygons_of(apart, one).size() == 2);
  }
  SECTION("runs that are no numbers of triangles") {
    const double wrong[] = {5, 1e300, -1, 7, 0, 1e300};
    CHECK(polygons_of(quad_and_more, wrong).size() == 3);
  }
}

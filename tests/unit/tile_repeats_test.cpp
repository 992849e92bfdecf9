#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "convert/tiles/repeats.h"

using namespace wrlkit;

namespace {

/// A wedge without symmetries, of many triangles along a curve.
Mesh wedge() {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  auto& p = m.positions.edit();
  constexpr std::uint32_t n = 40;
  for (std::uint32_t i = 0; i <= n; ++i) {
    const double a = 0.07 * i;
    for (const double v : {std::cos(a), std::sin(a), 0.1 * a, 0.8 * std::cos(a), 0.7 * std::sin(a), 0.3})
      p.push_back(v);
  }
  for (std::uint32_t i = 0; i < n; ++i)
    for (const std::uint32_t c : {0u, 1u, 2u, 1u, 3u, 2u}) m.corners.push_back(2 * i + c);
  return m;
}

tiles::Piece moved(const Matrix& frame, std::uint32_t look = 0) {
  tiles::Piece out{"part", look, 0, wedge()};
  auto& p = out.mesh.positions.edit();
  for (std::size_t i = 0; i < p.size(); i += 3) {
    const Vec3 at = frame.point({p[i], p[i + 1], p[i + 2]});
    std::ranges::copy(at, p.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return out;
}

constexpr Vec3 site{5'000'000, 250, -3'000'000};

Matrix place(int i, const Vec3& scale = {1, 1, 1}) {
  return translation_matrix(site + Vec3{3.0 * i, 0.5 * i, 0}) * rotation_matrix({0, 0.6, 0.8, 0.7 * i}) *
         scale_matrix(scale);
}

}  // namespace

TEST_CASE("tiles: what a surface repeats stands where it stood", "[tile_repeats]") {
  std::vector<tiles::Piece> pieces;
  for (int i = 0; i < 5; ++i) pieces.push_back(moved(place(i, i == 3 ? Vec3{2, 2, 2} : Vec3{1, 1, 1})));
  const auto found = tiles::repeats_of(pieces, 2e-4);
  REQUIRE(found.size() == 1);
  REQUIRE(found[0].places.size() == 5);
  CHECK(found[0].places[3].where.scale == Vec3{2, 2, 2});
  const auto& mesh = found[0].mesh;
  for (const auto& [piece, where] : found[0].places) {
    const Matrix frame = matrix_of(where);
    const auto& p = pieces[piece].mesh.positions;
    for (std::size_t i = 0; i < p.size(); i += 3) {
      const Vec3 at = frame.point({mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]});
      CHECK(length(at - Vec3{p[i], p[i + 1], p[i + 2]}) < 2e-4);
    }
  }
}

TEST_CASE("tiles: mirrors, shears, other looks and lines are no repeats", "[tile_repeats]") {
  std::vector<tiles::Piece> pieces;
  for (int i = 0; i < 3; ++i) pieces.push_back(moved(place(i)));
  Matrix sheared = place(7);
  sheared(0, 1) += 0.3;
  pieces.push_back(moved(place(4, {1, 1, -1})));
  pieces.push_back(moved(place(5, {1, 2, 1})));
  pieces.push_back(moved(place(6), 1));
  pieces.push_back(moved(sheared));
  pieces.push_back(moved(place(8)));
  pieces.back().mesh.kind = Mesh::Kind::lines;
  CHECK(tiles::repeats_of(pieces, 2e-4).empty());
  // The fourth of its kind.
  pieces.push_back(moved(place(9)));
  const auto found = tiles::repeats_of(pieces, 2e-4);
  REQUIRE(found.size() == 1);
  std::vector<std::uint32_t> who;
  for (const auto& p : found[0].places) who.push_back(p.piece);
  CHECK(who == std::vector<std::uint32_t>{0, 1, 2, 8});
}

TEST_CASE("tiles: of repeats those are taken that save most", "[tile_repeats]") {
  std::vector<tiles::Piece> pieces;
  for (int i = 0; i < 12; ++i) pieces.push_back(moved(place(i), i < 4 ? 0 : 1));
  const auto found = tiles::repeats_of(pieces, 2e-4);
  REQUIRE(found.size() == 2);
  const auto one = tiles::worthwhile(found, 1);
  REQUIRE(one.size() == 1);
  CHECK(one[0].places.size() == 8);
  CHECK(tiles::worthwhile(found, 0).empty());
  // A triangle is not worth a node.
  for (auto& p : pieces) {
    p.mesh.corners.resize(3);
    p.mesh.positions.edit().resize(9);
  }
  CHECK(tiles::repeats_of(pieces, 2e-4).size() == 2);
  CHECK(tiles::worthwhile(tiles::repeats_of(pieces, 2e-4), 9).empty());
}

namespace {

/// A pipe of sixteen sides with caps, or, of four, a beam.
tiles::Piece pipe(const Matrix& frame, std::uint32_t sides) {
  tiles::Piece out{"part", 0, 0, {}};
  Mesh& m = out.mesh;
  m.kind = Mesh::Kind::faces;
  m.crease_angle = 0.5;
  auto& p = m.positions.edit();
  for (std::uint32_t i = 0; i < sides; ++i)
    for (const double y : {0., 1.}) {
      const double a = 2 * std::numbers::pi * (i + 0.5) / sides;
      const Vec3 at = frame.point({std::cos(a), y, std::sin(a)});
      p.insert(p.end(), at.begin(), at.end());
    }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const auto a = 2 * i, b = 2 * ((i + 1) % sides);
    m.corners.insert(m.corners.end(), {a, a + 1, b, b, a + 1, b + 1});
    if (i > 0 && i + 1 < sides) m.corners.insert(m.corners.end(), {0, a, b, 1, b + 1, a + 1});
  }
  return out;
}

}  // namespace

TEST_CASE("tiles: pipes of other lengths and radii are one surface, scaled along their axes", "[tile_repeats]") {
  for (const std::uint32_t sides : {16u, 4u}) {
    std::vector<tiles::Piece> pieces;
    for (int i = 0; i < 4; ++i) pieces.push_back(pipe(place(i, {0.1 + 0.05 * i, 9.0 - 2 * i, 0.1 + 0.05 * i}), sides));
    // An oval pipe is none of them, nor a beam whose sides are no longer square to one another.
    const Matrix turned = sides == 4 ? rotation_matrix({0, 1, 0, 0.3}) : Matrix{};
    pieces.push_back(pipe(place(5) * scale_matrix({0.1, 1, 0.2}) * turned, sides));
    const auto found = tiles::repeats_of(pieces, 2e-4);
    REQUIRE(found.size() == 1);
    CHECK(found[0].places.size() == 4);
    for (const auto& [piece, where] : found[0].places) {
      const Matrix frame = matrix_of(where);
      const auto& p = pieces[piece].mesh.positions;
      const auto& m = found[0].mesh.positions;
      for (std::size_t i = 0; i < p.size(); i += 3)
        CHECK(length(frame.point({m[i], m[i + 1], m[i + 2]}) - Vec3{p[i], p[i + 1], p[i + 2]}) < 2e-4);
      CHECK(where.scale_orientation[3] == 0);
    }
  }
}

TEST_CASE("tiles: a cone of another length is another surface, as shading would show", "[tile_repeats]") {
  std::vector<tiles::Piece> pieces;
  for (int i = 0; i < 6; ++i) {
    pieces.push_back(pipe(place(0), 16));
    auto& p = pieces.back().mesh.positions.edit();
    for (std::size_t k = 0; k < p.size(); k += 6) {
      const Vec3 low = Vec3{p[k], p[k + 1], p[k + 2]}, middle = place(0).point({});
      std::ranges::copy(middle + (1.2 + 0.1 * i) * (low - middle), p.begin() + static_cast<std::ptrdiff_t>(k));
    }
  }
  CHECK(tiles::repeats_of(pieces, 2e-4).empty());
}

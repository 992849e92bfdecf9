// combine-lightmap packs pages again: as many texels as there is to see, and no more than a budget.
#include <cmath>

#include "light/render/texture.h"
#include "scenegraph/looks/texture_transform_node.h"
#include "tests/unit/lightmap_fixture.h"

using namespace wrlkit;

namespace {

constexpr TextureSampler clamped{.s = Wrap::clamp, .t = Wrap::clamp};

/// A page of this many texels along each side: grey that grows to the right, 100 in the lower half.
std::string page(int side) {
  std::string out =
      " lightmap DEF Page PixelTexture { image " + std::to_string(side) + " " + std::to_string(side) + " 1";
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) out += " " + std::to_string(y < side / 2 ? 100 : 50 + 150 * x / side);
  return out + " }";
}

/// A square with that part of the page.
std::string lit(double left, double low, double right, double high) {
  auto at = [](double x, double y) { return std::to_string(x) + " " + std::to_string(y) + ", "; };
  return "IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ]"
         " texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] }"
         " lightCoord TextureCoordinate { point [ " +
         at(left, low) + at(right, low) + at(right, high) + at(left, high) + "] } }";
}

/// What a Shape shows at places between its first corner and the third one.
std::vector<double> along_diagonal(Lit& w, std::size_t shape_number) {
  const Scene& s = w.scene();
  const NodeId shape = w.of(nodes::Shape)[shape_number], appearance = s.get(shape, nodes::shape::appearance);
  const auto image = w.picture(s.get(appearance, nodes::appearance::texture));
  REQUIRE(image);
  const auto texture = drawing::Texture::make(*image);
  const auto map = read_texture_transform(s, s.get(appearance, nodes::appearance::textureTransform)).map();
  const Mesh mesh = w.mesh(s.get(shape, nodes::shape::geometry));
  const float *a = mesh.texcoord.at(mesh.texcoord.index[0]), *b = mesh.texcoord.at(mesh.texcoord.index[2]);
  std::vector<double> out;
  for (double t = 0.05; t < 1; t += 0.1) {
    const auto [u, v] = map(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]));
    out.push_back(255 * texture->sample(u, v, 1, clamped).color.x);
  }
  return out;
}

const std::string plain = "material Material { diffuseColor 1 1 1 } ";

/// Two large squares, even and graded, one that is textured, and two that share a geometry, turned against one another.
std::string room() {
  std::string fine = "texture PixelTexture { image 32 32 1";
  for (int i = 0; i < 1024; ++i) fine += i * 7 % 11 < 5 ? " 255" : " 60";
  const std::string piece = "DEF Piece " + lit(0, 0, 1, 1);
  return shape(plain + page(64), lit(0.05, 0.05, 0.45, 0.45)) +
         shape(plain + "lightmap USE Page", lit(0.05, 0.55, 0.45, 0.95)) +
         shape(plain + fine + " } lightmap USE Page", lit(0.55, 0.05, 0.67, 0.17)) +
         shape(plain + "lightmap USE Page lightmapTransform TextureTransform { scale 0.2 0.2 translation 3 3 }",
               piece) +
         shape(plain +
                   "lightmap USE Page lightmapTransform TextureTransform { scale 0.2 0.2 rotation 1.5707963267948966 "
                   "translation 3 -4.9 }",
               "USE Piece");
}

}  // namespace

TEST_CASE("combine-lightmap: only what is textured gets the texels of textures", "[lightmap]") {
  Lit whole(room()), packed(room());
  whole.run("combine-lightmap{tolerance=0,max-size=64}");
  packed.run("combine-lightmap{tolerance=0}");
  CHECK(whole.stats["combine-lightmap.texels"] == 64 * 64);
  CHECK(whole.diag.count(Diag::texture_coarser) == 1);
  CHECK(packed.diag.messages().empty());
  CHECK(packed.stats["combine-lightmap.texels"] <= 128 * 64);  // 8 x 8 texels of light for 32 pixels: 16 pages of these
  CHECK(packed.stats["combine-lightmap.pages"] == 1);
  for (const std::size_t i : {0, 1, 3, 4}) {
    const auto a = along_diagonal(whole, i), b = along_diagonal(packed, i);
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(b[k] == Approx(a[k]).margin(1.5));
  }
}

TEST_CASE("combine-lightmap: even light takes few texels, and looks the same", "[lightmap]") {
  const std::string even = shape(plain + page(64), lit(0.02, 0.02, 0.98, 0.48));
  Lit whole(even), packed(even);
  whole.run("combine-lightmap{tolerance=0}");
  packed.run("combine-lightmap");
  CHECK(whole.stats["combine-lightmap.texels"] >= 32 * 64);
  CHECK(packed.stats["combine-lightmap.texels"] <= 64);
  for (const double v : along_diagonal(packed, 0)) CHECK(v == Approx(100).margin(1));
}

TEST_CASE("combine-lightmap: a budget of texels or bytes is kept where it hurts least, and its cost is said",
          "[lightmap]") {
  Lit whole(room()), small(room());
  whole.run("combine-lightmap{tolerance=0,max-size=64}");
  small.run("combine-lightmap{texels=1024}");
  CHECK(small.stats["combine-lightmap.texels"] <= 1024);
  CHECK(small.diag.count(Diag::light_budget) == 1);
  CHECK(small.diag.count(Diag::light_budget_missed) == 0);
  for (const std::size_t i : {0, 1, 3, 4}) {
    const auto a = along_diagonal(whole, i), b = along_diagonal(small, i);
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(b[k] == Approx(a[k]).margin(8));
  }
  auto size_of_pictures = [](Lit& w) {
    std::size_t bytes = 0;
    for (const NodeId t : w.of(nodes::ImageTexture))
      bytes += w.resources.bytes(w.scene().get(t, nodes::image_texture::url), {}, w.diag)->bytes.size();
    return bytes;
  };
  Lit cheap(room());
  cheap.run("combine-lightmap{budget=400}");
  CHECK(size_of_pictures(cheap) <= 400);
  CHECK(cheap.diag.count(Diag::light_budget) == 1);
  Lit impossible(room());
  impossible.run("combine-lightmap{texels=4}");
  CHECK(impossible.diag.count(Diag::light_budget_missed) == 1);
}

TEST_CASE("combine-lightmap: packed again, places of the lightmap itself move", "[lightmap]") {
  Lit w(room());
  w.run("combine-lightmap{into=lightmap,texels=1024}");
  const NodeId shape = w.of(nodes::Shape)[1], appearance = w.scene().get(shape, nodes::shape::appearance);
  CHECK(w.scene().get(appearance, nodes::appearance::material));
  const auto image = w.picture(w.scene().get(appearance, nodes::appearance::lightmap));
  REQUIRE(image);
  CHECK(image->width * image->height <= 1024);
  const Mesh mesh = w.mesh(w.scene().get(shape, nodes::shape::geometry));
  const float *left = mesh.lightcoord.at(mesh.lightcoord.index[0]),
              *right = mesh.lightcoord.at(mesh.lightcoord.index[2]);
  const auto texture = drawing::Texture::make(*image);
  auto grey = [&](double t) {
    return texture->sample(left[0] + t * (right[0] - left[0]), left[1] + t * (right[1] - left[1]), 1, clamped).color.x;
  };
  CHECK(grey(0.9) > grey(0.1) + 0.1);
}

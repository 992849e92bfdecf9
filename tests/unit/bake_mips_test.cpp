// Smaller versions of a page: they must not mix charts.
#include "passes/lightmap/borders.h"
#include "tests/unit/bake_fixture.h"

using namespace wrlkit;
using namespace wrlkit::bake_tests;

namespace {

/// A version of a picture: linear, green; row 0 the lowest.
struct Level {
  int width = 0, height = 0;
  std::vector<double> texels;

  double at(int x, int y) const {
    return texels[std::size_t(std::clamp(y, 0, height - 1)) * width + std::clamp(x, 0, width - 1)];
  }
  /// As a bilinear filter shows it, 0 to 255.
  double shown(double s, double t) const {
    const double x = s * width - 0.5, y = t * height - 0.5;
    const int u = static_cast<int>(std::floor(x)), v = static_cast<int>(std::floor(y));
    double sum = 0;
    for (int k = 0; k < 4; ++k)
      sum += (k & 1 ? x - u : 1 - (x - u)) * (k >> 1 ? y - v : 1 - (y - v)) * at(u + (k & 1), v + (k >> 1));
    return 255 * linear_to_srgb(sum);
  }
};

Level first_level(const Image& image) {
  Level out{image.width, image.height, {}};
  for (int y = image.height; y-- > 0;)
    for (int x = 0; x < image.width; ++x)
      out.texels.push_back(
          srgb_to_linear(image.pixels[(std::size_t(y) * image.width + x) * image.channels + 1] / 255.0));
  return out;
}

Level half(const Level& from) {
  Level out{(from.width + 1) / 2, (from.height + 1) / 2, {}};
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      out.texels.push_back((from.at(2 * x, 2 * y) + from.at(2 * x + 1, 2 * y) + from.at(2 * x, 2 * y + 1) +
                            from.at(2 * x + 1, 2 * y + 1)) /
                           4);
  return out;
}

/// Plates of many sizes under the sun, some of which face away from it: each is of one brightness.
std::string plates() {
  std::string out = "DirectionalLight { direction 0 -1 0 } ";
  for (int i = 0; i < 24; ++i) {
    const auto size = std::to_string(0.5 + 0.06 * i);
    out += "Transform { translation " + std::to_string(9 * i) + " 0 0 rotation 1 0 0 " + std::to_string(2.4 * i) +
           " children Shape { " + material(0.5) +
           " geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 0 0 1, " + size + " 0 1, " + size +
           " 0 0 ] } coordIndex [ 0 1 2 3 -1 ] } } } ";
  }
  return out;
}

/// The largest difference from the middle of a face that its border shows at a level, 0 to 255.
double worst_seam(Baked& b, int level) {
  const Scene& scene = b.world->scene;
  double worst = 0;
  for (NodeId shape : all_nodes(scene)) {
    if (!scene.is(shape, nodes::Shape)) continue;
    const NodeId look = scene.get(shape, nodes::shape::appearance), map = scene.get(look, nodes::appearance::lightmap);
    REQUIRE(map);
    const auto image = b.resources.image(scene.get(map, nodes::image_texture::url), scene.where(map), b.diag);
    REQUIRE(image);
    const Level whole = first_level(*image);
    Level small = whole;
    for (int l = 0; l < level; ++l) small = half(small);
    MeshScratch scratch;
    Mesh mesh;
    MeshJob job{scene, scene.get(shape, nodes::shape::geometry), mesh, scratch, b.ctx};
    read_mesh(job);
    triangulate(job, {});
    REQUIRE(mesh.lightcoord.index.size() == mesh.corners.size());
    auto place = [&](std::size_t t, double u, double v) {
      std::array<double, 2> at{};
      const double w[] = {u, v, 1 - u - v};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 2; ++i) at[i] += w[k] * mesh.lightcoord.at(mesh.lightcoord.index[3 * t + k])[i];
      return at;
    };
    for (std::size_t t = 0; t < mesh.corners.size() / 3; ++t) {
      const auto middle = place(t, 1. / 3, 1. / 3);
      for (int i = 0; i <= 20; ++i)
        for (int j = 0; i + j <= 20; ++j) {
          const auto at = place(t, i / 20., j / 20.);
          worst = std::max(worst, std::fabs(small.shown(at[0], at[1]) - whole.shown(middle[0], middle[1])));
        }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("bake: smaller versions of a page keep its charts apart", "[bake]") {
  const std::string options = "quality=draft,sky=none,max-size=512,denoise=false,mips=";
  for (const int mips : {2, 4}) {
    Baked b(plates(), options + std::to_string(mips));
    for (int level = 0; level < mips; ++level) {
      INFO(mips << " versions, level " << level);
      CHECK(worst_seam(b, level) <= 2);
    }
  }
  Baked narrow(plates(), options + "1");
  CHECK(worst_seam(narrow, 3) > 20);
}

TEST_CASE("bake: few charts have room around them by default, very many do not lose their texels to it", "[bake]") {
  Baked few(plates(), "quality=draft,sky=none");
  CHECK(worst_seam(few, 2) <= 2);
  auto texels = [](const char* mips) {
    std::string many;
    for (int i = 0; i < 900; ++i)
      many += "Transform { translation " + std::to_string(i % 30) + " 0 " + std::to_string(i / 30) +
              " children Shape { " + material(0.5) + " geometry Box { size 0.1 " + std::to_string(0.1 + 1e-4 * i) +
              " 0.1 } } } ";
    Baked b(many, std::string("quality=draft,sky=none,max-size=256,mips=") + mips);
    return b.stats["lightmap.texels"];
  };
  CHECK(texels("0") > 0.8 * static_cast<double>(texels("1")));
}

TEST_CASE("borders: which level keeps charts apart, and whose texels lie between them", "[bake]") {
  // Two charts of 4 by 8 texels, 8 apart, in a picture of 16 by 8.
  std::vector<std::uint16_t> chart(16 * 8);
  for (std::size_t y = 0; y < 8; ++y)
    for (std::size_t x = 0; x < 4; ++x) {
      chart[y * 16 + x] = 1;
      chart[y * 16 + x + 12] = 2;
    }
  const bake::ChartMap map{chart, 16, 8};
  CHECK(bake::last_separate_level(map) == 2);
  const auto sources = bake::sources_beyond_borders(map, 2);
  CHECK(sources[5] == 3);
  CHECK(sources[10] == 12);
  CHECK(sources[2] == 2);
}

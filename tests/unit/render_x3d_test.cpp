// What X3D 4.0 has in addition to VRML97: pictures of materials, hatches, dashes (ISO/IEC 19775-1:2023, 12.4).
#include <functional>
#include <numeric>

#include "tests/unit/render_fixture.h"

using namespace wrlkit;
using namespace wrlkit::render_tests;

namespace {

/// The middle of a square that fills the view, under the headlight or none.
Rgb seen(const std::string& material, const std::string& more = "", const std::string& around = "") {
  Studio s;
  s.header = "#X3D V4.0 utf8\nPROFILE Full\n";
  const std::string square = quad(-4, -4, 4, 4, 0, "texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] }");
  return middle(s.render(view + around + shape(square, material, more)));
}

std::string picture(const std::string& field, const std::string& pixel) {
  return field + " PixelTexture { image 1 1 3 " + pixel + " } ";
}

}  // namespace

TEST_CASE("render: a picture of emission is multiplied by emissiveColor") {
  CHECK(seen("diffuseColor 0 0 0 emissiveColor 1 1 0 " + picture("emissiveTexture", "0x804020")) == Rgb{128, 64, 0});
  const std::string physical = "baseColor 0 0 0 emissiveColor 1 1 0 " + picture("emissiveTexture", "0x804020");
  CHECK(seen("", "material PhysicalMaterial { " + physical + "}") == Rgb{128, 64, 0});
}

TEST_CASE("render: occlusion dims the ambient light by its strength") {
  const std::string lamp = dark + "DirectionalLight { intensity 0 ambientIntensity 0.5 } ",
                    white = "diffuseColor 1 1 1 ambientIntensity 1 ";
  CHECK(seen(white, "", lamp) == Rgb{128, 128, 128});
  CHECK(seen(white + picture("occlusionTexture", "0x000000"), "", lamp) == Rgb{0, 0, 0});
  CHECK(seen(white + "occlusionStrength 0.5 " + picture("occlusionTexture", "0x000000"), "", lamp) == Rgb{64, 64, 64});
}

TEST_CASE("render: a normal map leans the normal along the sides of the picture") {
  auto grey = [](const std::string& pixel, const std::string& more = "") {
    return seen("diffuseColor 1 1 1 " + more + picture("normalTexture", pixel))[0];
  };
  CHECK(std::abs(grey("0x8080ff") - 255) <= 1);
  CHECK(std::abs(grey("0xda80da") - 180) <= 3);  // 45 degrees to the side
  CHECK(std::abs(grey("0xda80da", "normalScale 0 ") - 255) <= 1);
}

TEST_CASE("render: alphaMode") {
  const std::string faint = "diffuseColor 1 1 1 transparency 0.6", strong = "diffuseColor 1 1 1 transparency 0.4";
  CHECK(seen(strong) == Rgb{153, 153, 153});
  CHECK(seen(faint, "alphaMode \"OPAQUE\"") == Rgb{255, 255, 255});
  CHECK(seen(faint, "alphaMode \"MASK\"") == Rgb{0, 0, 0});
  CHECK(seen(strong, "alphaMode \"MASK\"") == Rgb{255, 255, 255});
  CHECK(seen(strong, "alphaMode \"MASK\" alphaCutoff 0.7") == Rgb{0, 0, 0});
}

TEST_CASE("render: widths of lines and sizes of points") {
  const auto lit = [](const std::string& properties, const std::string& geometry) {
    Studio s;
    s.header = "#X3D V4.0 utf8\nPROFILE Full\n";
    return area(s.render(view + dark + shape(geometry, "emissiveColor 1 1 1", properties)));
  };
  const std::string line = "IndexedLineSet { coord Coordinate { point [ -4 0 0, 4 0 0 ] } coordIndex [ 0 1 ] }",
                    dot = "PointSet { coord Coordinate { point [ 0 0 0 ] } }";
  const double thin = lit("", line), small = lit("", dot);
  CHECK(lit("lineProperties LineProperties { linewidthScaleFactor 4 }", line) / thin == Approx(4).epsilon(0.1));
  CHECK(lit("lineProperties LineProperties { linewidthScaleFactor 4 applied FALSE }", line) == thin);
  CHECK(lit("pointProperties PointProperties { pointSizeScaleFactor 3 pointSizeMaxValue 9 }", dot) / small ==
        Approx(9).epsilon(0.25));
  CHECK(lit("pointProperties PointProperties { pointSizeScaleFactor 3 }", dot) == small);
}

TEST_CASE(
    "render: hatches are horizontal lines a sixtieth of the height apart, and all that is seen of what is not filled") {
  const auto drawn = [](const std::string& fill) {
    Studio s;
    s.header = "#X3D V4.0 utf8\nPROFILE Full\n";
    s.options.width = s.options.height = 240;
    s.options.samples = 1;
    const std::string look =
        "material UnlitMaterial { emissiveColor 0 0 1 } fillProperties FillProperties { " + fill + " }";
    const std::string square =
        "IndexedFaceSet { coordIndex [ 0 1 2 3 -1 ] coord Coordinate { point [ -9 -9 0, 9 -9 0, 9 9 0, -9 9 0 ] } }";
    return s.render("Background { skyColor 0 1 0 } " + view + "Shape { appearance Appearance { " + look +
                    " } geometry " + square + " }");
  };
  const auto rows = [](const Image& image, const Rgb& color) {
    int n = 0;
    for (int y = 0; y < image.height; ++y) n += pixel(image, image.width / 2, y) == color;
    return n;
  };
  const Rgb red{255, 0, 0}, blue{0, 0, 255}, green{0, 255, 0};
  const Image filled = drawn("hatchColor 1 0 0"), open = drawn("hatchColor 1 0 0 filled FALSE");
  CHECK(rows(filled, red) == 60);
  CHECK(rows(filled, blue) == 180);
  CHECK(rows(open, red) == 60);
  CHECK(rows(open, green) == 180);
  CHECK(rows(drawn("hatched FALSE"), blue) == 240);
}

TEST_CASE("render: a dash is a twentieth of the height, a gap two thirds of it; a pattern goes on around corners") {
  Studio s;
  s.header = "#X3D V4.0 utf8\nPROFILE Full\n";
  s.options.width = s.options.height = 300;
  s.options.samples = 1;
  const auto row = [&](const std::string& type, const std::string& points) {
    const std::string look =
        "material Material { emissiveColor 1 0 0 } lineProperties LineProperties { linetype " + type + " }";
    const Image image =
        s.render("OrthoViewpoint { fieldOfView [ -1 -1 1 1 ] position 0 0 9 } Shape { appearance Appearance { " + look +
                 " } geometry LineSet { vertexCount 3 coord Coordinate { point [ " + points + " ] } } }");
    std::string out;
    for (int x = 0; x < image.width; ++x) out += pixel(image, x, 150)[0] > 0 || pixel(image, x, 149)[0] > 0 ? '#' : ' ';
    return out;
  };
  const auto drawn = [](const std::string& row) { return std::ranges::count(row, '#'); };
  const std::string plain = row("1", "-2 0 0, 0 0 0, 2 0 0"), dashed = row("2", "-2 0 0, 0 0 0, 2 0 0");
  CHECK(drawn(plain) == 300);
  CHECK(drawn(dashed) == Approx(180).margin(8));
  CHECK(drawn(row("3", "-2 0 0, 0 0 0, 2 0 0")) == Approx(100).margin(12));
  const std::string other = row("2", "-2 0 0, 0.033 0 0, 2 0 0");  // but for a pixel of the round corner
  CHECK(std::inner_product(other.begin(), other.end(), dashed.begin(), 0, std::plus{}, std::not_equal_to{}) <= 2);
  CHECK(row("9", "-2 0 0, 0 0 0, 2 0 0") == plain);
}

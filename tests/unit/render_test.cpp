// Pictures against what the lighting model and the perspective say they are: single pixels, areas, whole pictures that
// must be equal.
#include <tbb/global_control.h>

#include "light/render/camera.h"
#include "light/render/light.h"
#include "light/render/shade.h"
#include "tests/unit/render_fixture.h"

using namespace wrlkit;
using namespace wrlkit::render_tests;
using drawing::V3;

TEST_CASE("render: the middle of a sphere under the headlight has its diffuse colour") {
  CHECK(middle(render(view + shape("Sphere { }", "diffuseColor 0.2 0.6 1"))) == Rgb{51, 153, 255});
}

TEST_CASE("render: an empty world is its background") {
  CHECK(middle(render("")) == Rgb{0, 0, 0});
  CHECK(middle(render("Background { skyColor 0.2 0.4 0.6 }")) == Rgb{51, 102, 153});
  Studio s;
  s.options.background = Vec3{1, 0.6, 0.2};
  CHECK(middle(s.render("Background { skyColor 0.2 0.4 0.6 }")) == Rgb{255, 153, 51});
}

TEST_CASE("render: a box covers what the perspective says") {
  // The front face of a box of 4 m stands 8 m from the eye: 4 m there are 4 * 100 / 8 = 50 pixels of 100.
  Studio s;
  s.options.width = 160;
  s.options.height = 100;
  auto image = s.render(view + "Shape { geometry Box { size 4 4 4 } }");
  CHECK(area(image) == Approx(50 * 50).epsilon(0.002));
  CHECK(pixel(image, 80 - 24, 50) == Rgb{255, 255, 255});
  CHECK(pixel(image, 80 - 27, 50) == Rgb{0, 0, 0});
}

TEST_CASE("render: fieldOfView is the angle of the shorter side") {
  Studio s;
  s.options.width = 100;
  s.options.height = 160;
  CHECK(area(s.render(view + "Shape { geometry Box { size 4 4 4 } }")) == Approx(50 * 50).epsilon(0.002));
}

TEST_CASE("render: a PixelTexture stands upright, its first pixel lower left") {
  const std::string texture =
      "texture PixelTexture { image 2 2 3 0xff0000 0x00ff00 0x0000ff 0xffff00 repeatS FALSE repeatT FALSE }";
  auto image = render(view + shape(quad(-4, -4, 4, 4), "", texture));
  CHECK(pixel(image, 15, 85) == Rgb{255, 0, 0});
  CHECK(pixel(image, 85, 85) == Rgb{0, 255, 0});
  CHECK(pixel(image, 15, 15) == Rgb{0, 0, 255});
  CHECK(pixel(image, 85, 15) == Rgb{255, 255, 0});
}

TEST_CASE("render: TextureTransform moves, turns and scales about its center") {
  // Four stripes of grey. Translation by a quarter brings the second one to where the first was.
  auto first_stripe = [](const std::string& fields) {
    const std::string texture =
        "texture PixelTexture { image 4 1 1 0 51 102 255 } textureTransform TextureTransform { " + fields + " }";
    return pixel(render(view + shape(quad(-4, -4, 4, 4), "", texture)), 20, 50)[0];
  };
  CHECK(std::abs(first_stripe("") - 0) <= 2);
  CHECK(std::abs(first_stripe("translation 0.25 0") - 51) <= 2);
  // Tc' = -C S R C T Tc: the point (1/8, 1/2) goes by C to (5/8, 1), by S to (5/4, 1), by -C to (3/4, 1/2): between 102
  // and 255.
  CHECK(std::abs(first_stripe("center 0.5 0.5 scale 2 1") - 179) <= 4);
  // A quarter turn: s' = -t, here a half: between the second stripe and the third.
  CHECK(std::abs(first_stripe("rotation 1.5707963") - 77) <= 2);
}

TEST_CASE("render: grey textures modulate the colour, coloured ones replace it") {
  auto seen = [](const std::string& material, const std::string& image) {
    return middle(render(view + shape(quad(-4, -4, 4, 4), material, "texture PixelTexture { image " + image + " }")));
  };
  CHECK(seen("diffuseColor 1 0.6 0.2", "1 1 1 0x80") == Rgb{128, 77, 26});
  CHECK(seen("diffuseColor 1 0.6 0.2", "1 1 3 0x336699") == Rgb{51, 102, 153});
  CHECK(seen("", "1 1 3 0x336699") == Rgb{51, 102, 153});
  // The alpha of the picture, not the transparency of the material, where it has one.
  CHECK(seen("diffuseColor 1 1 1 transparency 0.9", "1 1 2 0xff99") == Rgb{153, 153, 153});
  CHECK(seen("diffuseColor 1 1 1 transparency 0.9", "1 1 4 0xff663399") == Rgb{153, 61, 31});
  CHECK(seen("diffuseColor 1 1 1 transparency 0.4", "1 1 3 0xffffff") == Rgb{153, 153, 153});
}

TEST_CASE("render: with one sample a pixel, a texture is averaged over the pixel") {
  // Two stripes a pixel, black and white; the middle of each pixel is the middle of one of them.
  Studio s;
  s.options.width = s.options.height = 100;
  s.options.samples = 1;
  const std::string stripes =
      "texture PixelTexture { image 4 1 1 0 255 0 255 } textureTransform TextureTransform { translation 0.003125 0 "
      "scale 40 160 }";
  auto image = s.render(view + shape(quad(-4, -4, 4, 4), "", stripes));
  for (int x = 12; x < 88; ++x) CHECK(std::abs(pixel(image, x, 50)[0] - 188) <= 2);  // half the light of white
}

TEST_CASE("render: an ImageTexture that cannot be had leaves the material") {
  Studio s;
  s.pictures.images["a.png"] = std::make_shared<Image>(Image{1, 1, 3, {10, 20, 30}});
  auto seen = [&](const std::string& url) {
    return middle(s.render(
        view + shape(quad(-4, -4, 4, 4), "diffuseColor 0.2 0.4 0.6", "texture ImageTexture { url \"" + url + "\" }")));
  };
  CHECK(seen("a.png") == Rgb{10, 20, 30});
  CHECK(seen("b.png") == Rgb{51, 102, 153});
}

TEST_CASE("render: what has no Material is not lit") {
  CHECK(middle(render(dark + view + "Shape { geometry Box { } }")) == Rgb{255, 255, 255});
  CHECK(middle(render(dark + view + shape("Box { }", "diffuseColor 1 1 1"))) == Rgb{0, 0, 0});
  CHECK(middle(render(dark + view + shape("Box { }", emitting("0.2 0.4 0.6")))) == Rgb{51, 102, 153});
}

TEST_CASE("render: mirroring and uneven scaling keep the light on the right side") {
  const std::string light = dark + "DirectionalLight { direction -1 0 0 } ",
                    ball = shape("Sphere { radius 3 }", "diffuseColor 1 1 1");
  auto plain = render(view + light + ball);
  CHECK(pixel(plain, 70, 50)[0] > 100);
  CHECK(pixel(plain, 30, 50)[0] == 0);
  CHECK(largest_difference(plain, render(view + light + transform("scale -1 1 1", ball))) <= 1);
  CHECK(largest_difference(plain, render(view + light + transform("scale 1 -1 1", ball))) <= 1);

  // A plane through x = z, stretched along x to 3 z = x, has the normal (-1, 0, 3) / sqrt(10).
  const std::string slope = shape(
      "IndexedFaceSet { coord Coordinate { point [ -1 -2 -1, 1 -2 1, 1 2 1, -1 2 -1 ] } coordIndex [ 0 1 2 3 -1 ] }",
      "diffuseColor 1 1 1");
  auto stretched = render(view + dark + "DirectionalLight { direction 0 0 -1 } " + transform("scale 3 1 1", slope));
  CHECK(middle(stretched)[0] == 242);
}

TEST_CASE("render: a solid face is not seen from behind, mirrored or not") {
  const std::string away =
      "IndexedFaceSet { coord Coordinate { point [ -1 -1 0, -1 1 0, 1 1 0, 1 -1 0 ] } coordIndex [ 0 1 2 3 -1 ] ";
  const Rgb white{255, 255, 255}, black{0, 0, 0};
  auto seen = [&](const std::string& fields, const std::string& around = "") {
    return middle(render(view + transform(around, shape(away + fields + "}", "diffuseColor 1 1 1"))));
  };
  CHECK(seen("") == black);
  CHECK(seen("solid FALSE") == white);
  CHECK(seen("ccw FALSE") == white);
  CHECK(seen("", "scale -1 1 1") == black);
  CHECK(seen("ccw FALSE", "scale -1 1 1") == white);
  CHECK(seen("", "rotation 0 1 0 3.14159265") == white);
}

TEST_CASE("render: faces back to back are each seen from their side") {
  const std::string front = shape(quad(-1, -1, 1, 1), emitting("1 0 0")),
                    back = transform("rotation 0 1 0 3.14159265", shape(quad(-1, -1, 1, 1), emitting("0 0 1")));
  CHECK(middle(render(view + front + back)) == Rgb{255, 0, 0});
  CHECK(middle(render(view + back + front)) == Rgb{255, 0, 0});
}

TEST_CASE("render: of two faces in one place the first is seen") {
  const std::string red = shape(quad(-1, -1, 1, 1), emitting("1 0 0")),
                    blue = shape(quad(-1, -1, 1, 1, 0, "solid FALSE"), emitting("0 0 1"));
  CHECK(middle(render(view + red + blue)) == Rgb{255, 0, 0});
  CHECK(middle(render(view + blue + red)) == Rgb{0, 0, 255});
}

TEST_CASE("render: transparent things let through what is behind them") {
  const std::string red = shape(quad(-1, -1, 1, 1, 2), emitting("1 0 0") + " transparency 0.4"),
                    green = shape(quad(-1, -1, 1, 1, 1), emitting("0 1 0") + " transparency 0.5");
  // 0.6 red, then 0.4 * 0.5 green, then 0.4 * 0.5 of the sky.
  CHECK(middle(render(view + green + red + "Background { skyColor 0 0 1 }")) == Rgb{153, 51, 51});
}

TEST_CASE("render: the lighting equation, term by term") {
  drawing::Light l;
  l.direction = {0, 0, -1};
  l.intensity = 0.5;
  l.ambient_intensity = 0.25;
  l.color = {1, 0.5, 0};
  drawing::Lit m{{0.8, 0.8, 0.8}, {0.3, 0.3, 0.3}, 0.5, 0.25};
  const double c = std::cos(0.5), s = std::sin(0.5);
  drawing::LitPoint at{{0, 0, 0}, {s, 0, c}, {0, 0, 1}};
  // The half vector is (0, 0, 1), too; the exponent is 32.
  double expected = 0.25 * 0.5 * 0.8 + 0.5 * c * 0.8 + 0.5 * 0.3 * std::pow(c, 32);
  V3 got = contribution(l, at, m);
  CHECK(got.x == Approx(expected));
  CHECK(got.y == Approx(expected / 2));
  CHECK(got.z == 0);

  at.normal = {0, 0, -1};
  CHECK(contribution(l, at, m).x == Approx(0.25 * 0.5 * 0.8));
}

TEST_CASE("render: a point light weakens with distance, in its own frame, and ends at its radius") {
  drawing::Light l;
  l.kind = drawing::Light::Kind::point;
  l.location = {0, 0, 4};
  l.attenuation = {1, 0.5, 0.25};
  l.radius = 10;
  drawing::Lit m{{1, 1, 1}, {0, 0, 0}, 0, 0};
  drawing::LitPoint at{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  CHECK(contribution(l, at, m).x == Approx(1 / (1 + 2 + 4.0)));
  l.to_local = drawing::scaling(V3(2)).inverse();  // scaled twice as large: 2 m of its own
  CHECK(contribution(l, at, m).x == Approx(1 / (1 + 1 + 1.0)));
  l.radius = 1.9;
  CHECK(contribution(l, at, m).x == 0);
}

TEST_CASE("render: a spot light falls off between beamWidth and cutOffAngle") {
  // A wall 5 m behind the spot, of which the picture shows 10 m in 101 pixels.
  const std::string spot = "SpotLight { location 0 0 5 direction 0 0 -1 beamWidth 0.2 cutOffAngle 0.6 radius 100 } ";
  auto image = render(dark + view + spot + shape(quad(-6, -6, 6, 6), "diffuseColor 1 1 1"));
  CHECK(middle(image)[0] == 255);
  for (int x : {55, 60, 65, 70, 75, 80, 82}) {
    double angle = std::atan((x - 50) * (10 / 101.0) / 5);
    double strength = angle < 0.2 ? 1 : (0.6 - angle) / 0.4;
    CHECK(std::abs(pixel(image, x, 50)[0] - 255 * strength * std::cos(angle)) < 1.5);
  }
  CHECK(pixel(image, 86, 50)[0] == 0);
}

TEST_CASE("render: a DirectionalLight lights its brothers and what is below them") {
  const std::string left = shape(quad(-3, -1, -1, 1), "diffuseColor 1 1 1"),
                    right = shape(quad(1, -1, 3, 1), "diffuseColor 1 1 1");
  const std::string light = "DirectionalLight { direction 0 0 -1 intensity 0.6 } ";
  auto image = render(dark + view + "Group { children [ Group { children [ " + left + "] } " + light + " ] } " + right);
  CHECK(pixel(image, 30, 50) == Rgb{153, 153, 153});
  CHECK(pixel(image, 70, 50) == Rgb{0, 0, 0});
  auto off = render(dark + view + "DirectionalLight { on FALSE } " + left);
  CHECK(pixel(off, 30, 50) == Rgb{0, 0, 0});
}

TEST_CASE("render: colours per face and per vertex") {
  const std::string points =
      "coord Coordinate { point [ -4 -1 0, 0 -1 0, 4 -1 0, 4 1 0, 0 1 0, -4 1 0 ] } coordIndex [ 0 1 4 5 -1 1 2 3 4 -1 "
      "] ";
  auto faces = render(
      view + shape("IndexedFaceSet { " + points + "colorPerVertex FALSE color Color { color [ 1 0 0, 0 0 1 ] } }"));
  CHECK(pixel(faces, 30, 50) == Rgb{255, 0, 0});
  CHECK(pixel(faces, 70, 50) == Rgb{0, 0, 255});
  auto vertices = render(view + shape("IndexedFaceSet { " + points +
                                      "color Color { color [ 1 0 0, 1 0 0, 0 0 1, 0 0 1, 1 0 0, 1 0 0 ] } }"));
  CHECK(pixel(vertices, 30, 50) == Rgb{255, 0, 0});
  // 2 m of 4 to the right of the middle; a pixel is 10 / 101 m.
  CHECK(std::abs(pixel(vertices, 70, 50)[2] - 255 * (20 * 10 / 101.0) / 4) < 1);
}

TEST_CASE("render: lines are as wide on the screen wherever they stand") {
  auto line = [](double z) {
    double x = 0.4 * (10 - z);  // 80 of 100 pixels at any depth
    auto p = [&](double s) { return std::to_string(s * x) + " 0.1 " + std::to_string(z) + " "; };
    return render(view +
                  shape("IndexedLineSet { coord Coordinate { point [ " + p(-1) + p(1) + "] } coordIndex [ 0 1 ] }",
                        emitting("1 1 1")));
  };
  for (double z : {0.0, 8.0, -90.0}) CHECK(area(line(z)) == Approx(1.5 * 0.8 * 101).epsilon(0.03));
}

TEST_CASE("render: lines and points take their own colours, and hide and are hidden") {
  const std::string line =
      "IndexedLineSet { coord Coordinate { point [ -3 0 0, 3 0 0 ] } color Color { color [ 1 0 0, 0 0 1 ] } coordIndex "
      "[ 0 1 -1 ] } ";
  const std::string cover = shape(quad(0, -1, 4, 1, 1), emitting("0 1 0"));
  auto image = render(view + shape(line) + cover);
  CHECK(pixel(image, 25, 50)[0] > 200);
  CHECK(pixel(image, 25, 50)[1] == 0);
  CHECK(pixel(image, 65, 50) == Rgb{0, 255, 0});
  auto points = render(
      view + shape("PointSet { coord Coordinate { point [ -2 0 0, 2 0 0 ] } color Color { color [ 1 0 0, 0 0 1 ] } }"));
  CHECK(pixel(points, 30, 50)[0] > 100);
  CHECK(pixel(points, 30, 50)[2] == 0);
  CHECK(pixel(points, 70, 50)[2] > 100);
  CHECK(area(points) == Approx(2 * 3.14159 / 3).epsilon(0.15));
}

TEST_CASE("render: a line on a face is in front of it") {
  const std::string line =
      shape("IndexedLineSet { coord Coordinate { point [ -3 0 0, 3 0 0 ] } coordIndex [ 0 1 -1 ] }", emitting("1 0 0"));
  auto image = render(view + transform("rotation 1 0 0 -0.8", shape(quad(-4, -4, 4, 4), emitting("0 0 1")) + line));
  for (int x = 25; x < 75; ++x) CHECK(pixel(image, x, 50)[0] > 150);
}

TEST_CASE("render: fog grows with the distance") {
  const std::string wall = shape(quad(-9, -9, 9, 9, -10), emitting("0 1 0"));  // 20 m away
  CHECK(middle(render(view + wall + "Fog { color 1 0 0 visibilityRange 50 }")) == Rgb{102, 153, 0});
  int left = static_cast<int>(255 * std::exp(-20.0 / 30) + 0.5);
  CHECK(middle(render(view + wall + "Fog { color 1 0 0 visibilityRange 50 fogType \"EXPONENTIAL\" }")) ==
        Rgb{255 - left, left, 0});
  CHECK(middle(render(view + wall + transform("scale 2 2 2", "Fog { color 1 0 0 visibilityRange 25 }"))) ==
        Rgb{102, 153, 0});
  CHECK(middle(render(view + wall + "Fog { color 1 0 0 visibilityRange 15 }")) == Rgb{255, 0, 0});
}

TEST_CASE("render: sky and ground are bands of colour by the angle") {
  const std::string back =
      "Background { skyColor [ 0 0 1, 0 1 0 ] skyAngle 1.5707963 groundColor [ 1 0 0, 1 1 1 ] groundAngle 1 } ";
  auto looking = [&](double up) {
    return middle(render("Viewpoint { orientation 1 0 0 " + std::to_string(up) + " } " + back));
  };
  auto close = [](Rgb a, Rgb b) { return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) <= 4; };
  CHECK(close(looking(1.5707963), {0, 0, 255}));
  CHECK(close(looking(0.78539816), {0, 128, 128}));
  CHECK(close(looking(-0.2), {0, 255, 0}));
  CHECK(close(looking(-1.5707963), {255, 0, 0}));
  CHECK(close(looking(-1.0707963), {255, 128, 128}));
}

TEST_CASE("render: a TextureBackground shows its textures, and its colours where it has none") {
  Studio s;
  s.header = "#X3D V3.3 utf8\nPROFILE Full\n";
  s.pictures.images["a"] = std::make_shared<const Image>(Image{1, 1, 3, {255, 153, 51}});
  const std::string sky =
      "TextureBackground { skyColor 0.2 0.4 0.6 backTexture PixelTexture { image 1 1 3 0xff0000 } "
      "frontTexture ImageTexture { url \"a\" } } ";
  CHECK(middle(s.render(sky)) == Rgb{255, 153, 51});
  CHECK(middle(s.render(sky + "Viewpoint { orientation 0 1 0 3.14159265 }")) == Rgb{255, 0, 0});
  CHECK(middle(s.render(sky + "Viewpoint { orientation 1 0 0 1.5707963 }")) == Rgb{51, 102, 153});
}

TEST_CASE("render: the six pictures of a Background are upright from inside") {
  Studio s;
  // Left half of the upper row red, right one green; lower row blue and white.
  s.pictures.images["a"] = std::make_shared<Image>(Image{2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}});
  const Rgb red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, white{255, 255, 255};
  auto looking = [&](const std::string& face, const std::string& orientation) {
    auto i = s.render("Background { " + face + "Url \"a\" } Viewpoint { fieldOfView 1.5707963 orientation " +
                      orientation + " }");
    return std::array{pixel(i, 10, 10), pixel(i, 90, 10), pixel(i, 10, 90), pixel(i, 90, 90)};
  };
  const std::array upright{red, green, blue, white};
  CHECK(looking("front", "0 1 0 0") == upright);
  CHECK(looking("left", "0 1 0 1.5707963") == upright);
  CHECK(looking("back", "0 1 0 3.1415927") == upright);
  CHECK(looking("right", "0 1 0 -1.5707963") == upright);
  CHECK(looking("top", "1 0 0 1.5707963") == upright);
  CHECK(looking("bottom", "1 0 0 -1.5707963") == upright);
}

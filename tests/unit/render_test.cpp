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
  for (int x = 12; x < 88; ++x) CHECK(std::abs(pixel(image, x, 50)[0] - 127) <= 2);
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

TEST_CASE("render: Viewpoints are found by name and description, in their transformation") {
  const std::string views =
      "Viewpoint { position 5 0 10 } DEF Named Viewpoint { position 50 0 10 description \"from the right\" } " +
      transform("translation 100 0 0 rotation 0 1 0 1.5707963", "DEF Turned Viewpoint { position 0 0 10 }");
  const std::string world = views + transform("translation 5 0 0", shape("Sphere { }", emitting("1 0 0"))) +
                            transform("translation 50 0 0", shape("Sphere { }", emitting("0 1 0"))) +
                            transform("translation 100 0 0", shape("Sphere { }", emitting("0 0 1")));
  Studio s;
  auto seen = [&](const std::string& name) {
    s.options.viewpoint = name;
    return middle(s.render(world));
  };
  CHECK(seen("") == Rgb{255, 0, 0});
  CHECK(seen("Named") == Rgb{0, 255, 0});
  CHECK(seen("from the right") == Rgb{0, 255, 0});
  CHECK(seen("Turned") == Rgb{0, 0, 255});
  CHECK(s.diag.count(Diag::viewpoint_not_found) == 0);
  CHECK(seen("None") == Rgb{255, 0, 0});
  CHECK(s.diag.count(Diag::viewpoint_not_found) == 1);
  s.options.look_at = LookAt{{50, 10, 0}, {50, 0, 0}, {0, 1, 0}};
  CHECK(seen("") == Rgb{0, 255, 0});
}

TEST_CASE("render: fit shows all of a box, with a margin") {
  using namespace drawing;
  for (auto [w, h] : {std::pair{1280, 960}, {300, 900}})
    for (V3 size : {V3(1, 1, 1), V3(100, 1, 0.1), V3(0.01, 5, 3), V3(4, 2, 0), V3(0, 9, 0)}) {
      Box box;
      box.add({1e6, -5, 3});
      box.add(V3(1e6, -5, 3) + size);
      Camera c = camera_on(box, {w, h, 0.785398});
      double most = 0;
      for (int i = 0; i < 8; ++i) {
        V3 p = c.project(box.corner(i));
        CHECK(p.z > 0);
        most = std::max({most, std::fabs(2 * p.x / p.z / w - 1), std::fabs(2 * p.y / p.z / h - 1)});
      }
      CHECK(most == Approx(0.9).epsilon(1e-6));
    }
}

TEST_CASE("render: a world far from the origin looks like one at the origin") {
  const std::string things = shape("Cone { }", "diffuseColor 0.8 0.5 0.2") +
                             transform("translation 2 1 -1", shape("Sphere { }", "specularColor 1 1 1"));
  auto near = render(view + things);
  auto far = render(transform("translation 1e6 -3e6 2e6", view + things));
  CHECK(largest_difference(near, far) <= 1);
  // The same with the distance in the coordinates themselves.
  auto wall = [&](double x) {
    return render(transform("translation " + std::to_string(-x) + " 0 0",
                            shape(quad(x - 2, -2, x + 2, 2), "diffuseColor 1 0.5 0")) +
                  view);
  };
  CHECK(largest_difference(wall(0), wall(8e6)) <= 1);
}

TEST_CASE("render: transformations without sense draw nothing and break nothing") {
  const std::string ball = shape("Sphere { }", emitting("1 1 1"));
  CHECK(area(render(view + transform("scale 0 0 0", ball))) == 0);
  CHECK(area(render(view + transform("scale 1 1 0", ball))) > 300);
  CHECK(area(render(view + transform("scale 1e300 1e300 1e300", transform("scale 1e300 1e300 1e300", ball)))) == 0);
  CHECK(area(render(
            view +
            shape("IndexedFaceSet { coord Coordinate { point [ 0 0 0, 0 0 0, 1e30 0 0 ] } coordIndex [ 0 1 2 ] }"))) ==
        0);
  CHECK(area(render("Viewpoint { position 1e300 0 0 } " + transform("scale 0 1 1", "PointLight { }") + ball)) >= 0);
  CHECK(area(render("Viewpoint { orientation 0 0 0 0 } " + transform("rotation 0 0 0 1", ball))) > 300);
}

TEST_CASE("render: a world that doubles itself forty times ends") {
  std::string world = "DEF G0 Group { children Shape { geometry Box { } } } ";
  for (int i = 1; i <= 40; ++i) {
    auto below = "G" + std::to_string(i - 1);
    world += "DEF G" + std::to_string(i) + " Group { children [ USE " + below + " USE " + below + " ] } ";
  }
  world += "Transform { translation 9 0 0 children Shape { geometry Box { } } } ";
  Diagnostics diag;
  auto parsed = parse_world("#VRML V2.0 utf8\n" + world, "bomb.wrl", {}, diag);
  auto stage_within = [&](const drawing::StageLimits& limits) {
    return drawing::set_stage(parsed->scene, diag, {.limits = limits});
  };
  const std::size_t nodes = parsed->scene.node_count();
  auto stage = stage_within({.visits = 100'000, .shapes = 1000});
  CHECK(stage.uses.size() == 1000 + nodes);
  CHECK(diag.count(Diag::expansion_limit) == 1);
  stage = stage_within({.visits = 1000, .shapes = 100'000});
  CHECK(stage.uses.size() <= 1000 + nodes);
  CHECK(diag.count(Diag::expansion_limit) == 2);
  // A limit for each node leaves room for what comes after the doublings.
  stage = stage_within({.uses = 1000});
  REQUIRE(stage.uses.size() == 1001);
  CHECK(stage.frames[stage.uses.back().frame].t.x == 9);
  CHECK(diag.count(Diag::expansion_limit) == 3);
  CHECK(middle(render(view + world)) == Rgb{255, 255, 255});
}

TEST_CASE("render: Billboards turn to the viewer") {
  const std::string sign = shape(quad(-2, -2, 2, 2), emitting("1 1 1"));
  const std::string from_side = "Viewpoint { position 10 0 0 orientation 0 1 0 1.5707963 fieldOfView 0.927295218 } ";
  CHECK(area(render(from_side + sign)) == 0);
  CHECK(area(render(from_side + "Billboard { children " + sign + " }")) == Approx(40.4 * 40.4).epsilon(0.01));
  CHECK(area(render(from_side + "Billboard { axisOfRotation 0 0 0 children " + sign + " }")) ==
        Approx(40.4 * 40.4).epsilon(0.01));
  CHECK(area(render(from_side + "Billboard { axisOfRotation 1 0 0 children " + sign + " }")) == 0);
}

TEST_CASE("render: LODs show the level that is asked for, or the one for their distance") {
  auto seen = [](std::optional<std::size_t> level, const std::string& fields,
                 RenderOptions::Mode mode = RenderOptions::Mode::preview) {
    std::string levels;
    for (const char* color : {"1 0 0", "0 1 0", "0 0 1", "1 1 1"}) levels += shape("Sphere { }", emitting(color));
    Studio s;
    s.options.level = level;
    s.options.mode = mode;
    return middle(s.render(view + transform("scale 2 2 2", "LOD { " + fields + " level [ " + levels + "] } ")));
  };
  const Rgb red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, white{255, 255, 255};
  const std::string near = "range [ 5.1 8 ]";
  CHECK(seen(0, near) == red);
  CHECK(seen(2, near) == blue);
  CHECK(seen(3, near) == white);
  CHECK(seen(99, near) == white);
  // The eye is 10 m away, 5 in the coordinates of the LOD.
  CHECK(seen({}, near) == red);
  CHECK(seen({}, "range [ 5 8 ]") == green);
  CHECK(seen({}, "range [ 4.9 5.1 ]") == green);
  CHECK(seen({}, "range [ 1 2 ]") == blue);  // the fourth level is one too many
  CHECK(seen({}, "range [ 1 2 3 4 4.5 ]") == white);
  CHECK(seen({}, "range [ 1 2 3 4 5.1 ]") == white);
  CHECK(seen({}, "") == red);
  CHECK(seen({}, "center 0 0 3 range 4 ") == red);
  CHECK(seen({}, "center 0 0 -3 range 6 ") == green);
  CHECK(seen({}, "range [ 1 2 ]", RenderOptions::Mode::path) == blue);
  CHECK(seen(1, "", RenderOptions::Mode::path) == green);
}

TEST_CASE("render: the level does not change where the picture is taken from, and LODs within levels have theirs") {
  Studio s;
  const std::string small = shape("Box { size 1 1 1 }", emitting("1 1 1")),
                    large = shape("Box { size 4 4 4 }", emitting("1 1 1"));
  s.options.fit = true;
  const double all = area(s.render("LOD { range 1 level [ " + large + small + " ] }"));
  s.options.level = 1;
  CHECK(area(s.render("LOD { range 1 level [ " + large + small + " ] }")) == Approx(all / 16).epsilon(0.3));
  const std::string red = shape("Box { }", emitting("1 0 0")), green = shape("Box { }", emitting("0 1 0")),
                    blue = shape("Box { }", emitting("0 0 1"));
  s.options.level.reset();
  CHECK(middle(s.render("LOD { range 1 level [ " + red + "Group { children LOD { range 1000 level [ " + green + blue +
                        "] } } ] }")) == Rgb{0, 255, 0});
}

TEST_CASE("render: wireframe shows edges, and only those in front") {
  Studio s;
  s.options.mode = RenderOptions::Mode::wireframe;
  auto image = s.render(view + shape(quad(-4, -4, 4, 4)) + shape(quad(-3, -3, 3, 2, -2)));
  CHECK(pixel(image, 2, 2) == Rgb{255, 255, 255});
  CHECK(pixel(image, 50, 30)[0] > 200);
  CHECK(pixel(image, 50, 30)[0] < 235);
  int dark_in_row = 0, dark_in_column = 0;
  for (int k = 0; k < 101; ++k) {
    dark_in_row += pixel(image, k, 40)[0] < 180;
    dark_in_column += pixel(image, 60, k)[0] < 180;
  }
  // Left edge, diagonal and right edge, each a pixel or two wide; likewise up and down.
  CHECK(dark_in_row >= 3);
  CHECK(dark_in_row <= 7);
  CHECK(dark_in_column >= 3);
  CHECK(dark_in_column <= 7);
}

TEST_CASE("render: the same picture on any number of threads") {
  std::string world = view;
  for (int i = 0; i < 40; ++i)
    world += transform(
        "translation " + std::to_string(i % 7 - 3) + " " + std::to_string(i % 5 - 2) + " 0",
        shape("Sphere { }", "transparency 0.3 specularColor 1 1 1") + shape("Box { }", "diffuseColor 1 0.5 0"));
  auto on = [&](std::size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return render(world);
  };
  CHECK(on(1).pixels == on(4).pixels);
}

TEST_CASE("render: instances look like copies") {
  using namespace drawing;
  Studio s;
  auto world =
      parse_world("#VRML V2.0 utf8\n" + dark + view + "DirectionalLight { direction -1 -1 -1 } " +
                      transform("translation -2 0 0", "DEF Ball " + shape("Sphere { }", "specularColor 1 1 1")) +
                      transform("translation 2 0 0 scale -1 2 0.5 rotation 0 0 1 1", "USE Ball ") +
                      transform("scale 1 1 0", "USE Ball "),
                  "test.wrl", {}, s.diag);
  std::string why;
  auto pipeline = Pipeline::parse("picture", why);
  PassContext ctx{s.diag, s.stats, nullptr};
  auto source = pipeline->run_lazily(world->scene, ctx);
  Stage stage = set_stage(world->scene, s.diag);
  MeshPool pool;
  std::vector<std::uint32_t> mesh_of(3, pool.add(source(stage.uses[0].geometry))), surface_of(3);
  Camera camera = camera_in(translation({0, 0, 10}), {101, 101, 0.927});
  std::size_t hits = 0;
  Tracer copies(stage, pool, mesh_of, camera, {}, s.diag),
      instances(stage, pool, mesh_of, camera, {.all_flat = 0}, s.diag);
  Surfaces surfaces(world->scene, nullptr, s.diag);
  Drawing drawing{stage, pool, surfaces, mesh_of, surface_of};
  for (int y = 0; y < 101; y += 5)
    for (int x = 0; x < 101; x += 5) {
      Ray ray{camera.eye, camera.direction(x + 0.3, y + 0.6)};
      Hit a, b;
      bool hit = copies.nearest(ray, 0, a);
      REQUIRE(hit == instances.nearest(ray, 0, b));
      if (!hit) continue;
      ++hits;
      CHECK(a.use == b.use);
      CHECK(a.distance == Approx(b.distance).epsilon(1e-5));
      CHECK(length(spot_at(drawing, ray, a).normal - spot_at(drawing, ray, b).normal) < 1e-3);
      CHECK(dot(spot_at(drawing, ray, a).normal, ray.direction) < 0.01);
    }
  CHECK(hits > 30);
}

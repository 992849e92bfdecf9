// Path-traced pictures against what integrals say they are (docs/lighting.md), in linear light.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "base/image/srgb.h"
#include "tests/unit/render_fixture.h"

using namespace wrlkit;
using namespace wrlkit::render_tests;

namespace {

struct PathStudio : Studio {
  PathStudio(int size, int samples) {
    options.mode = RenderOptions::Mode::path;
    options.width = options.height = size;
    options.samples = samples;
  }
};

std::string grey(double linear) {
  const double v = linear_to_srgb(linear);
  return fmt::format("{} {} {}", v, v, v);
}

double linear(int level) { return srgb_to_linear(level / 255.0); }

/// The mean of the red of all pixels, linear.
double mean(const Image& i) {
  double sum = 0;
  for (std::size_t p = 0; p < i.pixels.size(); p += 3) sum += linear(i.pixels[p]);
  return sum / (static_cast<double>(i.pixels.size()) / 3);
}

/// The same of a square of pixels.
double mean(const Image& i, int x0, int y0, int side) {
  double sum = 0;
  for (int y = y0; y < y0 + side; ++y)
    for (int x = x0; x < x0 + side; ++x) sum += linear(pixel(i, x, y)[0]);
  return sum / (side * side);
}

const std::string room =
    "IndexedFaceSet { solid FALSE coord Coordinate { point [ -1 -1 -1, 1 -1 -1, 1 1 -1, -1 1 -1, -1 -1 1, 1 -1 1, 1 1 "
    "1, -1 1 1 ] } "
    "coordIndex [ 0 1 2 3 -1 4 5 6 7 -1 0 1 5 4 -1 3 2 6 7 -1 0 3 7 4 -1 1 2 6 5 -1 ] } ";

}  // namespace

TEST_CASE("path tracing: what shines is as bright as it says, and a ball in a white sky as its colour") {
  PathStudio s(21, 2);
  const std::string ball = view + shape("Sphere { }", "diffuseColor 0.5 0.2 0.8");
  CHECK(middle(s.render(view + shape("Sphere { }", emitting("0.2 0.4 0.6")))) == Rgb{51, 102, 153});
  CHECK(middle(s.render(ball + "Background { skyColor 1 1 1 }")) == Rgb{128, 51, 204});
  CHECK(pixel(s.render(ball + "Background { skyColor 0 0 1 }"), 0, 0) == Rgb{0, 0, 255});
  s.options.background = Vec3{0.2, 0.4, 0.6};
  CHECK(pixel(s.render(ball), 0, 0) == Rgb{51, 102, 153});
}

TEST_CASE("path tracing: both sides of an edge are mixed as they are displayed") {
  PathStudio s(1, 16);
  const std::string right_half =
      "IndexedFaceSet { solid FALSE coord Coordinate { point [ 0 -9 0, 9 -9 0, 9 9 0, 0 9 0 ] } coordIndex [ 0 1 2 3 ] "
      "}";
  const std::string world = view + "Background { skyColor 0 0 0 } " + shape(right_half, emitting("1 1 1"));
  CHECK(s.render(world).pixels[0] == Approx(127.5).margin(1));
}

TEST_CASE("path tracing: a closed room that shines everywhere is as bright everywhere") {
  // Emission 0.2 and albedo 0.5: 0.2 + 0.1 + 0.05 + ... = 0.4.
  PathStudio s(24, 48);
  const Image inside = s.render("Viewpoint { position 0.3 0.2 0.5 fieldOfView 1.5 } " +
                                shape(room, "diffuseColor " + grey(0.5) + " emissiveColor " + grey(0.2)));
  CHECK(mean(inside) == Approx(0.4).epsilon(0.004));  // half a level of 255 is 0.007
  for (int y = 0; y < 24; y += 6)
    for (int x = 0; x < 24; x += 6) CHECK(mean(inside, x, y, 6) == Approx(0.4).epsilon(0.006));
}

TEST_CASE("path tracing: a plate under a PointLight") {
  // Albedo a, lamp at height h: a lin(i) cos / d^2, here with cos = h / d.
  PathStudio s(101, 4);
  s.options.headlight = true;  // does not count
  const double albedo = 0.4, h = 2;
  const Image plate = s.render(view + "PointLight { location 0 0 2 attenuation 0 0 1 } " +
                               shape(quad(-5, -5, 5, 5), "diffuseColor " + grey(albedo)));
  for (double x : {0.0, 1.0, 2.0, 4.0}) {
    const double d2 = h * h + x * x;
    // 101 pixels show 10 m of the plane.
    CHECK(linear(pixel(plate, 50 + static_cast<int>(std::lround(x * 10.1)), 50)[0]) ==
          Approx(albedo * h / (d2 * std::sqrt(d2))).epsilon(0.03));
  }
}

TEST_CASE("path tracing: shadows, reflected light, what is behind glass, and backs of solid faces") {
  PathStudio s(41, 8);
  const std::string sun = "DirectionalLight { direction 0 0 -1 } ",
                    floor = shape(quad(-5, -5, 5, 5), "diffuseColor 0.5 0.5 0.5");
  // Something that stands next to the line of sight, but in the light of a slanting sun.
  const std::string slanting = "DirectionalLight { direction 1 0 -1 } ",
                    screen = shape(quad(-3, -1, -1, 1, 2, "solid FALSE"), "diffuseColor 0 0 0");
  CHECK(middle(s.render(view + slanting + floor)) == Rgb{108, 108, 108});
  CHECK(middle(s.render(view + slanting + floor + screen)) == Rgb{0, 0, 0});
  // Light that comes over a red wall is red.
  const Rgb beside = middle(s.render(view + "DirectionalLight { direction -1 0 0 } " + floor +
                                     shape("IndexedFaceSet { solid FALSE coord Coordinate { point [ -1 -5 0, -1 5 0, "
                                           "-1 5 4, -1 -5 4 ] } coordIndex [ 0 1 2 3 ] }",
                                           "diffuseColor 1 0 0")));
  CHECK(beside[0] > 60);
  CHECK(beside[1] == 0);
  // Half of the light of a lamp comes through a pane; half of what is displayed is seen through it.
  const std::string pane = shape(quad(-2, -2, 2, 2, 1, "solid FALSE"), "diffuseColor 0 0 0 transparency 0.5"),
                    beside_sun = "DirectionalLight { direction 1 0 -1 } ",
                    hung = "Transform { translation -3 0 2 children " + pane + "} ";
  const double lit = linear(middle(s.render(view + beside_sun + floor))[0]);
  CHECK(linear(middle(s.render(view + beside_sun + floor + hung))[0]) == Approx(lit / 2).epsilon(0.02));
  CHECK(middle(s.render(view + shape(quad(-5, -5, 5, 5), emitting("0.8 0.8 0.8")) + pane)) == Rgb{102, 102, 102});
  const std::string red = shape(quad(-2, -2, 2, 2, 1), "diffuseColor 0 0 0 emissiveColor 1 0.2 0 transparency 0.75");
  CHECK(middle(s.render(view + shape(quad(-5, -5, 5, 5), emitting("0.4 0.4 1")) + red)) == Rgb{140, 89, 191});
  // The camera looks through a back, as in a browser; light does not pass it.
  const std::string away = shape(quad(-2, -2, 2, 2, 1, "ccw FALSE"), "diffuseColor 0 0 0");
  CHECK(middle(s.render(view + sun + floor + away)) == Rgb{0, 0, 0});
  CHECK(middle(s.render(view + shape(quad(-5, -5, 5, 5), emitting("0.2 0.4 0.6")) + away)) == Rgb{51, 102, 153});
}

TEST_CASE("path tracing: the rays of a pixel are spread evenly") {
  // A window covers a small share of what a wall sees. Of 256 independent rays some 8 would meet it, give or take 3.
  PathStudio s(16, 16);
  const std::string shutter = shape(
      "IndexedFaceSet { solid FALSE coord Coordinate { point [ -90 -90 1, 90 -90 1, 90 90 1, -90 90 1, -0.2 -0.2 1, "
      "0.2 -0.2 "
      "1, 0.2 0.2 1, -0.2 0.2 1 ] } coordIndex [ 0 1 5 4 -1 1 2 6 5 -1 2 3 7 6 -1 3 0 4 7 ] }",
      "diffuseColor 0 0 0");
  const Image wall = s.render("Viewpoint { position 0 0 0.9 fieldOfView 0.02 } Background { skyColor 1 1 1 } " +
                              shape(quad(-9, -9, 9, 9), "diffuseColor 1 1 1") + shutter);
  double sum = 0, squares = 0;
  for (std::size_t p = 0; p < wall.pixels.size(); p += 3) {
    const double v = linear(wall.pixels[p]);
    sum += v;
    squares += v * v;
  }
  const double n = 16 * 16, mean = sum / n;
  CHECK(mean == Approx(0.0479).epsilon(0.02));  // 0.99 of the form factor of a square of 0.4 m, 1 m away
  CHECK(std::sqrt(squares / n - mean * mean) / mean < 0.15);
}

TEST_CASE("path tracing: textures, and Billboards as the camera sees them") {
  PathStudio s(41, 2);
  const std::string texture = "texture PixelTexture { image 2 1 3 0xff0000 0x0000ff repeatS FALSE }",
                    white = "Background { skyColor 1 1 1 } ";
  const Image flag = s.render(view + white + shape(quad(-4, -4, 4, 4), "", texture));
  CHECK(pixel(flag, 5, 20)[0] > 250);
  CHECK(pixel(flag, 5, 20)[2] == 0);
  CHECK(pixel(flag, 35, 20)[2] > 250);
  const std::string sign = "Billboard { children " + shape(quad(-4, -4, 4, 4), emitting("0.2 0.4 0.6")) + "}";
  CHECK(middle(s.render("Viewpoint { position 10 0 0 orientation 0 1 0 1.5707963 } " + sign)) == Rgb{51, 102, 153});
}

TEST_CASE("path tracing: any number of threads makes the same picture, and its progress ends at 1") {
  PathStudio s(50, 2);
  double share = 0;
  s.options.done = [&](double done) {
    CHECK(done > share);
    share = done;
  };
  const std::string world = view + "PointLight { location 0 3 3 } " +
                            shape(quad(-4, -4, 4, 4), "diffuseColor 1 0.5 0.2") +
                            shape("Sphere { }", "diffuseColor 0.5 0.5 0.5");
  const Image many = s.render(world);
  CHECK(share == 1);
  share = 0;
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(s.render(world).pixels == many.pixels);
}

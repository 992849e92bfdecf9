// The pictures of a MultiTexture as one (ISO/IEC 19775-1, 18.4.3).
#include "passes/lower_x3d/texture_blend.h"
#include "tests/unit/render_fixture.h"

using namespace wrlkit;
using namespace wrlkit::render_tests;

namespace {

const std::string square = quad(-4, -4, 4, 4, 0, "texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] }");

std::string dot_of(const std::string& pixel, int channels = 3) {
  return "PixelTexture { image 1 1 " + std::to_string(channels) + " " + pixel + " } ";
}

struct Seen {
  Rgb color;
  std::size_t n_lost;
};

/// The middle of a square with two pictures, on a white material under the headlight.
Seen seen(const std::string& one, const std::string& other, const std::string& how, const std::string& around = "") {
  Studio s;
  s.header = "#X3D V4.0 utf8\nPROFILE Full\n";
  const std::string texture = "texture MultiTexture { " + how + " texture [ " + one + other + " ] }";
  const Rgb color = middle(s.render(view + around + shape(square, "diffuseColor 1 1 1", texture)));
  return {color, s.diag.count(Severity::lost)};
}

x3d::Rgba blended(const char* mode, const x3d::Rgba& picture, const x3d::Rgba& below, const char* function = "") {
  return x3d::TextureBlend(mode, "", function)(picture, {below}, {0.2, 0.4, 0.6, 0.5}).value;
}

void check_near(const x3d::Rgba& a, const x3d::Rgba& b) {
  for (std::size_t i = 0; i < 4; ++i) CHECK(a[i] == Approx(b[i]).margin(1e-12));
}

}  // namespace

TEST_CASE("multi texture: modes of two colours") {
  const x3d::Rgba a{0.25, 0.5, 1, 0.5}, b{0.5, 0.5, 0.5, 1};
  check_near(blended("MODULATE", a, b), {0.125, 0.25, 0.5, 0.5});
  check_near(blended("modulate2x", a, b), {0.25, 0.5, 1, 1});
  check_near(blended("REPLACE", a, b), a);
  check_near(blended("SELECTARG2", a, b), b);
  check_near(blended("OFF", a, b), b);
  check_near(blended("ADD", a, b), {0.75, 1, 1, 1});
  check_near(blended("ADDSIGNED", a, b), {0.25, 0.5, 1, 1});
  check_near(blended("SUBTRACT", a, b), {0, 0, 0.5, 0});
  check_near(blended("ADDSMOOTH", a, b), {0.625, 0.75, 1, 1});
  check_near(blended("BLENDTEXTUREALPHA", a, b), {0.375, 0.5, 0.75, 0.75});
  check_near(blended("BLENDFACTORALPHA", a, b), {0.375, 0.5, 0.75, 0.75});
  check_near(blended("BLENDCURRENTALPHA", a, b), a);
  check_near(blended("MODULATEALPHA_ADDCOLOR,REPLACE", a, b), {0.5, 0.75, 1, 0.5});
  check_near(blended("MODULATEINVALPHA_ADDCOLOR,SELECTARG2", a, b), {0.5, 0.75, 1, 1});
  check_near(blended("MODULATEINVCOLOR_ADDALPHA,REPLACE", a, b), {0.875, 0.75, 0.5, 0.5});
  check_near(blended("DOTPRODUCT3", {1, 0.5, 0.5, 0.25}, {1, 0.5, 0.5, 1}), {1, 1, 1, 0.25});
  check_near(blended("MODULATE,REPLACE", a, b, "COMPLEMENT"), {0.875, 0.75, 0.5, 0.5});
  check_near(blended("REPLACE", a, b, "ALPHAREPLICATE"), {0.5, 0.5, 0.5, 0.5});
}

TEST_CASE("multi texture: what light does to the result") {
  using x3d::TextureBlend;
  const x3d::Rgba half{0.5, 0.5, 0.5, 1};
  CHECK(TextureBlend("", "", "")(half, {}, half).lit);
  CHECK(TextureBlend("", "", "")(half, {}, half).exact);
  CHECK(!TextureBlend("REPLACE", "", "")(half, {}, half).lit);
  CHECK(!TextureBlend("MODULATE", "FACTOR", "")(half, {}, half).lit);
  CHECK(TextureBlend("MODULATE", "DIFFUSE", "")(half, {half, false}, half).lit);
  CHECK(!TextureBlend("ADD", "", "")(half, {}, half).exact);
  CHECK(TextureBlend("ADD", "", "")(half, {half, false}, half).exact);
}

TEST_CASE("render: pictures of a MultiTexture over one another") {
  const std::string orange = dot_of("0xff8040"), grey = dot_of("0x808080"), clear = dot_of("0x00ff0080", 4);
  CHECK(seen(orange, grey, "").color == Rgb{128, 64, 32});
  CHECK(seen(orange, grey, "").n_lost == 0);
  const Seen added = seen(orange, grey, "mode [ \"MODULATE\" \"ADD\" ]");
  CHECK(added.color == Rgb{255, 255, 192});
  CHECK(added.n_lost == 1);  // light is on all of it
  CHECK(seen(orange, clear, "mode [ \"REPLACE\" \"BLENDTEXTUREALPHA\" ]").n_lost == 0);
  CHECK(seen(orange, grey, "mode [ \"REPLACE\" \"MODULATE\" ]", dark).color == Rgb{128, 64, 32});
  CHECK(seen(orange, grey, "mode [ \"MODULATE\" \"OFF\" ]").color == Rgb{255, 128, 64});
  CHECK(seen(orange, grey, "mode [ \"MODULATE\" \"MODULATE\" ] source [ \"\" \"FACTOR\" ] color 1 0.5 0", dark).color ==
        Rgb{128, 64, 0});
}

TEST_CASE("render: pictures of a MultiTexture in another scale repeat within the first one") {
  Studio s;
  s.header = "#X3D V3.3 utf8\nPROFILE Full\n";
  const std::string stripes = "PixelTexture { image 2 1 1 0x00 0xff } ", white = dot_of("0xffffff"),
                    scales =
                        "textureTransform MultiTextureTransform { textureTransform [ TextureTransform { } "
                        "TextureTransform { scale 4 1 } ] } ";
  const auto drawn = s.render(view + shape(square, "diffuseColor 1 1 1",
                                           "texture MultiTexture { texture [ " + white + stripes + " ] } " + scales));
  int changes = 0;
  for (int x = 1; x < drawn.width; ++x) changes += (pixel(drawn, x, 50)[0] > 127) != (pixel(drawn, x - 1, 50)[0] > 127);
  CHECK(changes >= 7);
  CHECK(s.diag.count(Severity::lost) == 0);
}

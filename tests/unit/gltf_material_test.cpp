// Materials and textures of VRML97 as those of glTF.
#include <catch2/catch.hpp>

#include "tests/unit/gltf_fixture.h"
#include "writers/gltf/images.h"
#include "writers/gltf/materials.h"
#include "writers/gltf/texture_transform.h"

using namespace wrlkit;
using namespace wrlkit::gltf_tests;
using namespace std::literals;

// -- materials

TEST_CASE("Material", "[gltf]") {
  auto g = convert(triangle("A",
                            "appearance Appearance { material DEF Red Material { diffuseColor 0.8 0.2 0.02 "
                            "emissiveColor 0.1 0 0 transparency 0.25 } }") +
                   triangle("B", "appearance DEF Look Appearance { material Material {} }") + triangle("C") +
                   triangle("D", "appearance Appearance {}"));
  auto a = g.material("A");
  CHECK(a["name"] == "Red");
  auto color = a["pbrMetallicRoughness"]["baseColorFactor"];
  CHECK(color[0].get<float>() == linear(0.8));
  CHECK(color[1].get<float>() == linear(0.2));
  CHECK(color[2].get<float>() == Approx(0.02 / 12.92));
  CHECK(color[3] == 0.75);
  CHECK(a["alphaMode"] == "BLEND");
  CHECK(a["emissiveFactor"][0].get<float>() == linear(0.1));
  CHECK(a["pbrMetallicRoughness"]["metallicFactor"] == 0);
  CHECK_FALSE(a["pbrMetallicRoughness"].contains("roughnessFactor"));
  CHECK_FALSE(a.contains("extensions"));
  CHECK_FALSE(a.contains("extras"));

  CHECK(g.material("B")["name"] == "Look");
  CHECK_FALSE(g.material("B").contains("alphaMode"));
  CHECK(g.material("C")["extensions"].contains("KHR_materials_unlit"));
  CHECK_FALSE(g.material("C")["pbrMetallicRoughness"].contains("baseColorFactor"));
  CHECK(g.primitive("C")["material"] == g.primitive("D")["material"]);
}

TEST_CASE("Shininess and specularColor are roughness, and are kept", "[gltf]") {
  CHECK(gltf::roughness(0.2, {0, 0, 0}) == 1);
  CHECK(gltf::roughness(0.2, {1, 1, 1}) == Approx(std::pow(2 / 27.6, 0.25)));
  CHECK(gltf::roughness(1, {0, 1, 0}) == Approx(std::pow(2 / 130.0, 0.25)));
  CHECK(gltf::roughness(1, {0.5, 0, 0}) == Approx(std::pow(0.02, 0.25)));
  CHECK(gltf::roughness(0.2, {0.01, 0, 0}) == 1);
  CHECK(gltf::roughness(0, {1, 1, 1}) == 1);
  CHECK(gltf::roughness(std::nan(""), {0, 7, 0}) == 1);
  auto m =
      convert(triangle("A", with_material("shininess 0.2 specularColor 1 1 1 ambientIntensity 0.5"))).material("A");
  CHECK(m["pbrMetallicRoughness"]["roughnessFactor"].get<float>() == Approx(std::pow(2 / 27.6, 0.25)));
  CHECK(m["extras"]["vrml97"]["Material"] == json::parse(R"({"specularColor": [1, 1, 1], "ambientIntensity": 0.5})"));
}

TEST_CASE("Equal appearances are one material, but for their names", "[gltf]") {
  auto g = convert(triangle("A", with_material("diffuseColor 1 0 0")) +
                   triangle("B", with_material("diffuseColor 1 0 0 transparency 0")) +
                   triangle("C", "appearance Appearance { material DEF M Material { diffuseColor 1 0 0 } }"));
  CHECK(g.j["materials"].size() == 2);
  CHECK(g.primitive("A")["material"] == g.primitive("B")["material"]);
}

// -- textures

TEST_CASE("PNG and JPEG are embedded as they are, once", "[gltf]") {
  Files files;
  files.files["a.png"] = png(3, {1, 2, 3});
  std::string error;
  files.files["b.jpg"] = *encode_jpeg({1, 1, 3, {9, 9, 9}}, 90, error);
  auto g = convert(triangle("A", with_picture("a.png")) + triangle("B", with_picture("b.jpg")) +
                       triangle("C", with_picture("a.png", "")),
                   &files);
  CHECK(g.j["images"].size() == 2);
  CHECK(g.picture(0) == files.files["a.png"]);
  CHECK(g.picture(1) == files.files["b.jpg"]);
  CHECK(g.j["images"][0]["mimeType"] == "image/png");
  CHECK(g.j["images"][1]["mimeType"] == "image/jpeg");
  CHECK(g.j["images"][0]["name"] == "a.png");
  CHECK(g.j["textures"].size() == 2);
  CHECK(g.j["textures"][0]["extras"]["vrml97"]["ImageTexture"]["url"] == json({"a.png"}));
  CHECK(files.decoded == 0);
}

TEST_CASE("Other pictures become PNG", "[gltf]") {
  Files files;
  files.files["dot.gif"] =
      "GIF89a\x01\x00\x01\x00\x80\x00\x00\xff\x00\x00\x00\x00\xff\x2c\x00\x00\x00\x00\x01\x00\x01\x00\x00\x02\x02\x44\x01\x00\x3b"s;
  auto g = convert(triangle("A", with_picture("dot.gif")), &files);
  REQUIRE(g.j["images"].size() == 1);
  CHECK(g.j["images"][0]["mimeType"] == "image/png");
  CHECK(g.j["images"][0]["name"] == "dot.png");
  std::string error;
  auto image = decode_image(g.picture(0), "", error);
  REQUIRE(image);
  CHECK(image->pixels == std::vector<std::uint8_t>{255, 0, 0});
}

TEST_CASE("A PNG in another colour space loses the chunk that says so", "[gltf]") {
  auto plain = png(3, {1, 2, 3});
  std::string gamma("\0\0\0\x04gAMA\0\x01\x86\xa0\x31\xe8\x96\x5f", 16);  // 1.0
  auto odd = plain.substr(0, 33) + gamma + plain.substr(33);
  auto portable = gltf::portable_image(odd, "image/png");
  CHECK(portable.usable);
  CHECK(portable.cleaned == plain);
  std::string usual("\0\0\0\x04gAMA\0\0\xb1\x8f\x0b\xfc\x61\x05", 16);  // 1 / 2.2
  CHECK_FALSE(gltf::portable_image(plain.substr(0, 33) + usual + plain.substr(33), "image/png").cleaned);
  CHECK_FALSE(gltf::portable_image(plain.substr(0, 40), "image/png").usable);
  CHECK_FALSE(gltf::portable_image("\xff\xd8\xff\xc0\0\x14\x08\0\x01\0\x01\x04"sv, "image/jpeg").usable);
}

TEST_CASE("PixelTexture begins at the bottom", "[gltf]") {
  auto g = convert(triangle(
      "A", "appearance Appearance { texture DEF Px PixelTexture { image 1 2 3 0xFF0000 0x0000FF repeatS FALSE } }"));
  REQUIRE(g.j["images"].size() == 1);
  std::string error;
  auto image = decode_image(g.picture(0), "", error);
  REQUIRE(image);
  CHECK(image->pixels == std::vector<std::uint8_t>{0, 0, 255, 255, 0, 0});
  CHECK(g.j["textures"][0]["name"] == "Px");
  CHECK(g.j["samplers"][0]["wrapS"] == 33071);
  CHECK_FALSE(g.j["samplers"][0].contains("wrapT"));
  CHECK_FALSE(
      convert(triangle("A", "appearance Appearance { texture PixelTexture { image 0 0 0 } }")).j.contains("images"));
}

TEST_CASE("A picture takes the place of the colour, or is multiplied by it", "[gltf]") {
  Files files;
  files.files["1.png"] = png(1, {100});
  files.files["2.png"] = png(2, {100, 100});
  files.files["3.png"] = png(3, {1, 2, 3});
  files.files["4.png"] = png(4, {1, 2, 3, 100});
  const std::string material = "material Material { diffuseColor 0.5 0.25 1 transparency 0.5 }",
                    color = "color Color { color [1 0 0, 1 0 0, 1 0 0] }";
  auto base = [](const json& m) { return m["pbrMetallicRoughness"].value("baseColorFactor", json({1, 1, 1, 1})); };
  auto diffuse = json({linear(0.5), linear(0.25), 1.f, 0.5f});
  for (int channels = 1; channels <= 4; ++channels) {
    auto name = std::to_string(channels) + ".png";
    auto g = convert(triangle("A", with_picture(name, material)) + triangle("B", with_picture(name, material), color) +
                         triangle("C", with_picture(name, ""), color),
                     &files);
    INFO(channels);
    bool replaces = channels >= 3, alpha = channels % 2 == 0;
    auto a = base(g.material("A")), b = base(g.material("B"));
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(a[i].get<float>() == (replaces ? 1.f : diffuse[i].get<float>()));
      CHECK(b[i] == 1);
    }
    CHECK(a[3] == (alpha ? 1 : 0.5));
    CHECK(g.material("A")["alphaMode"] == "BLEND");
    CHECK(g.primitive("B")["attributes"].contains(replaces ? "_COLOR" : "COLOR_0"));
    CHECK_FALSE(g.primitive("B")["attributes"].contains(replaces ? "COLOR_0" : "_COLOR"));
    CHECK(g.primitive("C")["attributes"].contains(replaces ? "_COLOR" : "COLOR_0"));
    CHECK(g.material("C").contains("extensions"));
    // What a picture hides is kept.
    auto kept = g.material("A").value("extras", json::object());
    CHECK((replaces ? kept["vrml97"]["Material"]["diffuseColor"] == json({0.5, 0.25, 1})
                    : !kept.contains("diffuseColor")));
    CHECK((!alpha || kept["vrml97"]["Material"]["transparency"] == 0.5));
  }
}

TEST_CASE("Alpha is cut or blended by what the picture has", "[gltf]") {
  Files files;
  files.files["full.png"] = png(4, {1, 2, 3, 255});
  files.files["mask.png"] = png(4, {1, 2, 3, 255, 1, 2, 3, 0});
  files.files["soft.png"] = png(2, {1, 254});
  auto mode = [&](const char* name) {
    return convert(triangle("A", with_picture(name)), &files).material("A").value("alphaMode", "OPAQUE");
  };
  CHECK(mode("full.png") == "OPAQUE");
  CHECK(mode("mask.png") == "MASK");
  CHECK(mode("soft.png") == "BLEND");
}

TEST_CASE("A picture that cannot be had leaves the material, and its node in extras", "[gltf]") {
  Files files;
  auto g = convert(triangle("A", with_picture("no.png")) +
                       triangle("B", "appearance Appearance { texture MovieTexture { url \"m.mpg\" speed 2 } }"),
                   &files);
  CHECK_FALSE(g.material("A")["pbrMetallicRoughness"].contains("baseColorTexture"));
  CHECK(g.material("A")["pbrMetallicRoughness"]["baseColorFactor"][1].get<float>() == linear(0.25));
  CHECK(g.material("A")["extras"]["vrml97"] == json::parse(R"({"ImageTexture": {"url": ["no.png"]}})"));
  CHECK(g.material("B")["extras"]["vrml97"] == json::parse(R"({"MovieTexture": {"url": ["m.mpg"], "speed": 2}})"));
  CHECK(g.diag.count(Diag::no_gltf_movie) == 1);
  CHECK_FALSE(g.j.contains("textures"));
}

namespace {

TexcoordMap affine(std::string_view fields) {
  Diagnostics diag;
  auto world = parse(
      "Shape { appearance Appearance { textureTransform TextureTransform { " + std::string(fields) + " } } }", diag);
  Scene& s = world->scene;
  return read_texture_transform(
             s, s.get(s.get(s.main.roots[0], nodes::shape::appearance), nodes::appearance::textureTransform))
      .map();
}

/// The matrix of KHR_texture_transform, T R S, on coordinates of glTF.
Vec2 apply(const gltf::UvTransform& t, double u, double v) {
  u *= t.scale[0];
  v *= t.scale[1];
  double c = std::cos(t.rotation), s = std::sin(t.rotation);
  return {c * u + s * v + t.offset[0], -s * u + c * v + t.offset[1]};
}

}  // namespace

TEST_CASE("TextureTransform in VRML's coordinates", "[gltf]") {
  auto a = affine("translation 0.5 0.25 scale 2 4 center 0.5 0.5");
  CHECK(a(0, 0)[0] == Approx(2 * (0.5 + 0.5) - 0.5));
  CHECK(a(0, 0)[1] == Approx(4 * (0.25 + 0.5) - 0.5));
  // -C S R C T: turned first, then scaled.
  auto b = affine("rotation 1.5707963267948966 scale 2 3");
  CHECK(b(1, 0)[0] == Approx(0).margin(1e-15));
  CHECK(b(1, 0)[1] == Approx(3));
  CHECK(b(0, 1)[0] == Approx(-2));
}

TEST_CASE("KHR_texture_transform says the same with V turned round", "[gltf]") {
  for (auto fields :
       {"translation 0.5 0.25", "scale 2 -3 center 0.5 0.5", "rotation 0.3 center 0.2 0.9",
        "rotation -2 scale 1.5 1.5 translation 1 2", "rotation 3.141592653589793 scale 2 5 center 0.1 0.2"}) {
    INFO(fields);
    auto a = affine(fields);
    auto t = gltf::uv_transform(a);
    REQUIRE(t);
    for (auto [s, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.3, 0.8}}) {
      CHECK(apply(*t, s, 1 - v)[0] == Approx(a(s, v)[0]));
      CHECK(apply(*t, s, 1 - v)[1] == Approx(1 - a(s, v)[1]));
    }
  }
  CHECK_FALSE(gltf::uv_transform(affine("rotation 0.3 scale 1 2")));
}

TEST_CASE("A TextureTransform that glTF cannot say is applied to the coordinates", "[gltf]") {
  Files files;
  files.files["a.png"] = png(3, {1, 2, 3});
  std::string texcoord = "texCoord TextureCoordinate { point [0 0, 1 0, 0.25 1] }";
  auto appearance = [](std::string_view t) {
    return "appearance Appearance { texture ImageTexture { url \"a.png\" } textureTransform TextureTransform { " +
           std::string(t) + " } }";
  };
  auto g = convert(triangle("A", appearance("scale 2 3 translation 0.5 0"), texcoord) +
                       triangle("B", appearance("rotation 0.3 scale 1 2"), texcoord),
                   &files);
  auto info = [&](std::string_view n) { return g.material(n)["pbrMetallicRoughness"]["baseColorTexture"]; };
  CHECK(info("A")["extensions"]["KHR_texture_transform"] == json::parse(R"({"offset": [1, -2], "scale": [2, 3]})"));
  CHECK(info("A")["extras"]["vrml97"]["TextureTransform"]["translation"] == json({0.5, 0}));
  CHECK(g.j["extensionsUsed"] == json({"KHR_materials_unlit", "KHR_texture_transform"}));
  CHECK(g.attribute("A", "TEXCOORD_0", 2) == std::vector<float>{0, 1, 1, 1, 0.25f, 0});
  CHECK_FALSE(info("B").contains("extensions"));
  CHECK(g.primitive("A")["attributes"]["POSITION"] == g.primitive("B")["attributes"]["POSITION"]);
  auto uv = g.attribute("B", "TEXCOORD_0", 2);
  CHECK(uv[2] == Approx(std::cos(0.3)));
  CHECK(uv[3] == Approx(1 - 2 * std::sin(0.3)));
}

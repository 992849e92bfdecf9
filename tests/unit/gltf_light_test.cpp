// Lights and Viewpoints of VRML97 as lights and cameras of glTF.
#include <catch2/catch.hpp>

#include "tests/unit/gltf_fixture.h"
#include "writers/gltf/cameras.h"

using namespace wrlkit;
using namespace wrlkit::gltf_tests;
using namespace std::literals;

// -- lights, cameras

TEST_CASE("Lights", "[gltf]") {
  auto g = convert(
      "DEF D DirectionalLight { direction 1 0 0 intensity 0.5 color 1 0.5 0 } "
      "DEF S SpotLight { location 1 2 3 direction 0 -1 0 cutOffAngle 0.5 beamWidth 0.2 radius 7 attenuation 0 0 1 }"
      "DEF Off PointLight { on FALSE } NavigationInfo { headlight FALSE }");
  auto light = [&](std::string_view name) {
    return g.j["extensions"]["KHR_lights_punctual"]["lights"]
              [g.node(name)["extensions"]["KHR_lights_punctual"]["light"].get<std::size_t>()];
  };
  CHECK(g.j["extensionsUsed"] == json({"KHR_lights_punctual"}));
  CHECK(light("D")["type"] == "directional");
  CHECK(light("D")["intensity"].get<double>() == Approx(pi / 2));
  CHECK(light("D")["color"][1].get<float>() == linear(0.5));
  CHECK_FALSE(light("D").contains("range"));
  auto turned = gltf::rotate(gltf::looking_along({1, 0, 0}), {0, 0, -1});
  CHECK(turned[0] == Approx(1));
  auto q = numbers(g.node("D")["rotation"]);
  CHECK(q[1] == Approx(-std::sqrt(0.5)));
  CHECK(q[3] == Approx(std::sqrt(0.5)));

  CHECK(g.node("S")["translation"] == json({1, 2, 3}));
  CHECK(light("S")["type"] == "spot");
  CHECK(light("S")["spot"] == json({{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}));
  CHECK(light("S")["range"] == 7);
  CHECK_FALSE(g.node("Off").contains("extensions"));
  CHECK(g.node("Off")["extras"]["vrml97"]["PointLight"]["on"] == false);
  CHECK(g.j["extensions"]["KHR_lights_punctual"]["lights"].size() == 2);
}

TEST_CASE("A point light is right at the mean distance of the world", "[gltf]") {
  std::string box = "Shape { geometry Box { size 2 2 2 } } NavigationInfo { headlight FALSE } ";
  auto intensity = [&](std::string_view light) {
    return convert(box + std::string(light))
        .j["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"]
        .get<double>();
  };
  // From (0, 3, 0), the mean square of the distances to the points of the cube is 3^2 + 3 / 3.
  CHECK(intensity("PointLight { location 0 3 0 }") == Approx(pi * 10));
  CHECK(intensity("PointLight { location 0 3 0 attenuation 0 0 1 }") == Approx(pi));
  CHECK(intensity("PointLight { location 0 3 0 attenuation 0 2 0 intensity 0.5 }") ==
        Approx(0.5 * pi * 10 / (2 * std::sqrt(10.0))));
  // It reaches a ball with a mean square of 3/5 2^2.
  CHECK(intensity("PointLight { location 0 3 0 radius 2 }") == Approx(pi * 2.4));
  auto scaled =
      convert(box + "Transform { scale 2 2 2 children PointLight { location 0 1.5 0 radius 10 attenuation 0 0 1 } }");
  auto light = scaled.j["extensions"]["KHR_lights_punctual"]["lights"][0];
  CHECK(light["range"].get<double>() == Approx(20));
  CHECK(light["intensity"].get<double>() == Approx(pi * 4));
}

TEST_CASE("Directions behind and degenerate cones", "[gltf]") {
  for (Vec3 d : {Vec3{0, 0, 1}, {0, 0, -1}, {1e-12, 0, 1}, {-3, 2, 5}, {0, 1e-3, 0}}) {
    auto to = gltf::rotate(gltf::looking_along(d), {0, 0, -1});
    double length = std::hypot(d[0], d[1], d[2]);
    for (std::size_t i = 0; i < 3; ++i) CHECK(to[i] == Approx(d[i] / length).margin(1e-8));
  }
  auto g = convert("SpotLight { cutOffAngle 0.5 beamWidth 1.5 } SpotLight { cutOffAngle 0 beamWidth 0 }");
  for (const auto& l : g.j["extensions"]["KHR_lights_punctual"]["lights"]) {
    if (l["type"] != "spot") continue;
    CHECK(l["spot"]["innerConeAngle"].get<double>() < l["spot"]["outerConeAngle"].get<double>());
    CHECK(l["spot"]["outerConeAngle"].get<double>() > 0);
  }
}

TEST_CASE("The headlight joins lights of the world's own", "[gltf]") {
  auto lights = [](std::string_view text) {
    return convert(text).j.value("/extensions/KHR_lights_punctual/lights"_json_pointer, json::array()).size();
  };
  CHECK(lights("Viewpoint {}") == 0);
  CHECK(lights("Viewpoint {} DirectionalLight {}") == 2);
  CHECK(lights("DirectionalLight {}") == 2);
  CHECK(lights("DirectionalLight {} NavigationInfo { headlight FALSE }") == 1);
  CHECK(lights("DirectionalLight { on FALSE }") == 0);
  auto g = convert("DEF A Viewpoint {} DEF B Viewpoint {} DirectionalLight {}");
  auto headlight = g.j["nodes"][g.node("A")["children"][0].get<std::size_t>()];
  CHECK(headlight["name"] == "headlight");
  CHECK_FALSE(g.node("B").contains("children"));
}

TEST_CASE("What lights lose is said", "[gltf]") {
  auto g = convert(
      "Group { children DirectionalLight { ambientIntensity 0.5 } } DirectionalLight {} PointLight {} PointLight { "
      "attenuation 0 0 1 }");
  CHECK(g.messages(Diag::no_gltf_light_value) ==
        std::vector{"DirectionalLight.ambientIntensity has no counterpart in glTF (lights: 1; this is the first)"s,
                    "PointLight.attenuation has no counterpart in glTF (lights: 1; this is the first)"s});
  CHECK(g.diag.count(Diag::no_gltf_light_scope) == 1);
}

TEST_CASE("Viewpoints", "[gltf]") {
  auto g = convert(
      "Shape { geometry Box { size 2 2 2 } } DEF V Viewpoint { position 0 0 9 orientation 0 1 0 1 fieldOfView 1.2 "
      "description \"Front\" } "
      "Viewpoint { description \"Side\" } NavigationInfo { avatarSize [ 0.002 1.6 0.75 ] visibilityLimit 15 }");
  auto v = g.node("V");
  CHECK(v["translation"] == json({0, 0, 9}));
  CHECK(numbers(v["rotation"])[1] == Approx(std::sin(0.5)));
  auto camera = g.j["cameras"][v["camera"].get<std::size_t>()];
  CHECK(camera["type"] == "perspective");
  CHECK(camera["name"] == "V");
  CHECK(camera["perspective"]["yfov"] == 1.2);
  CHECK_FALSE(camera["perspective"].contains("aspectRatio"));
  CHECK(camera["perspective"]["zfar"] == 15);
  CHECK(camera["perspective"]["znear"].get<double>() == Approx(0.001));
  CHECK(v["extras"]["vrml97"]["Viewpoint"]["description"] == "Front");
  CHECK(g.j["cameras"][1]["name"] == "Side");
  CHECK(g.node("Side").contains("camera"));
  CHECK(g.j["scenes"][0]["extras"]["vrml97"]["NavigationInfo"]["visibilityLimit"] == 15);
}

TEST_CASE("Clipping planes follow the size of the world", "[gltf]") {
  auto planes = [](std::string_view size, std::string_view position) {
    auto c = convert("Shape { geometry Box { size " + std::string(size) + " } } Viewpoint { position " +
                     std::string(position) + " }")
                 .j["cameras"][0]["perspective"];
    return std::pair{c["znear"].get<double>(), c["zfar"].get<double>()};
  };
  auto far_corner = [](double half, double z) { return 2 * std::sqrt(2 * half * half + (z + half) * (z + half)); };
  CHECK(planes("200 200 200", "0 0 300").second == Approx(far_corner(100, 300)));
  CHECK(planes("200 200 200", "0 0 300").first == Approx(0.125));
  CHECK(planes("0.02 0.02 0.02", "0 0 0.05").first == Approx(far_corner(0.01, 0.05) / 1000));
  CHECK(planes("200000 200000 200000", "0 0 300000").first == Approx(far_corner(1e5, 3e5) / 1e5));
}

// Morph targets and KHR_animation_pointer: what glTF says at twenty times is what the interpolators of VRML say then.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"
#include "tests/unit/temp_folder.h"
#include "writers/gltf/gltf.h"

using namespace wrlkit;
using json = nlohmann::json;

namespace {

constexpr int n_times = 20;
constexpr double cycle = 4;

struct Written {
  json j;
  std::string bin;
  Diagnostics diag;

  std::vector<double> numbers(std::size_t accessor) const {
    const auto &a = j["accessors"][accessor], &v = j["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t width = a["type"] == "SCALAR" ? 1
                              : a["type"] == "VEC2" ? 2
                              : a["type"] == "VEC3" ? 3
                                                    : 4,
                      at = v.value("byteOffset", 0) + a.value("byteOffset", 0);
    std::vector<float> f(a["count"].get<std::size_t>() * width);
    std::memcpy(f.data(), bin.data() + at, f.size() * sizeof(float));
    return {f.begin(), f.end()};
  }

  /// What a channel of the first animation says (glTF 2.0, appendix C: LINEAR): of a node, or of a pointer.
  std::vector<double> sample(const std::string& target, double time) const {
    for (const auto& c : j["animations"][0]["channels"]) {
      const auto& t = c["target"];
      const std::string name = t["path"] == "pointer"
                                   ? t["extensions"]["KHR_animation_pointer"]["pointer"].get<std::string>()
                                   : t["path"].get<std::string>();
      if (name != target) continue;
      const auto& s = j["animations"][0]["samplers"][c["sampler"].get<std::size_t>()];
      const auto in = numbers(s["input"]), out = numbers(s["output"]);
      const std::size_t width = out.size() / in.size();
      std::size_t i = 0;
      while (i + 2 < in.size() && in[i + 1] <= time) ++i;
      const double f = std::clamp((time - in[i]) / (in[i + 1] - in[i]), 0.0, 1.0);
      std::vector<double> value;
      for (std::size_t k = 0; k < width; ++k)
        value.push_back(out[width * i + k] + f * (out[width * (i + 1) + k] - out[width * i + k]));
      return value;
    }
    FAIL("no channel " << target);
    return {};
  }

  /// An attribute of the first mesh with its morph targets at these weights, for each corner.
  std::vector<double> corners(const char* attribute, const std::vector<double>& weights) const {
    const auto& p = j["meshes"][0]["primitives"][0];
    auto v = numbers(p["attributes"][attribute]);
    for (std::size_t t = 0; t < weights.size(); ++t) {
      const auto d = numbers(p["targets"][t][attribute]);
      for (std::size_t i = 0; i < v.size(); ++i) v[i] += weights[t] * d[i];
    }
    if (!p.contains("indices")) return v;
    std::vector<double> out;
    const auto& a = j["accessors"][p["indices"].get<std::size_t>()];
    const auto& view = j["bufferViews"][a["bufferView"].get<std::size_t>()];
    std::vector<std::uint16_t> index(a["count"].get<std::size_t>());
    std::memcpy(index.data(), bin.data() + view.value("byteOffset", 0) + a.value("byteOffset", 0), index.size() * 2);
    for (auto i : index) out.insert(out.end(), v.begin() + 3 * i, v.begin() + 3 * i + 3);
    return out;
  }
};

Written write(const std::string& body, bool pointers = true) {
  TempFolder folder;
  Written w;
  Diagnostics parsed;
  auto world = parse_world("#VRML V2.0 utf8\n" + body, "test", {}, parsed);
  Statistics stats;
  PassContext context{w.diag, stats};
  std::string why;
  auto pipeline = Pipeline::parse("gltf", why);
  auto meshes = pipeline->run_lazily(world->scene, context);
  REQUIRE(write_gltf(world->scene, meshes, {.binary = false, .animation_pointer = pointers}, nullptr, folder / "a.gltf",
                     w.diag));
  std::ifstream(folder / "a.gltf") >> w.j;
  std::ifstream bin(folder / "a.bin", std::ios::binary);
  w.bin.assign(std::istreambuf_iterator<char>(bin), {});
  return w;
}

/// ISO/IEC 14772-1, 4.6.8, for lists of any width.
std::vector<double> interpolate(const std::vector<double>& key, const std::vector<double>& value, double f) {
  const std::size_t width = value.size() / key.size();
  std::size_t i = 0;
  while (i + 2 < key.size() && f >= key[i + 1]) ++i;
  const double t = std::clamp((f - key[i]) / (key[i + 1] - key[i]), 0.0, 1.0);
  std::vector<double> out;
  for (std::size_t k = 0; k < width; ++k)
    out.push_back(value[width * i + k] + t * (value[width * (i + 1) + k] - value[width * i + k]));
  return out;
}

std::string list(const std::vector<double>& v) {
  std::string s = "[";
  for (double x : v) s += " " + std::to_string(x);
  return s + " ]";
}

double time_of(int i) { return (i + 0.437) / n_times; }
double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

const std::string start = "DEF C TimeSensor { cycleInterval 4 loop TRUE } ";
std::string routes(const std::string& event) {
  return " ROUTE C.fraction_changed TO I.set_fraction ROUTE I.value_changed TO " + event;
}

/// A roof of two quadrilaterals whose ridge rises, and one end of which opens.
const std::vector<double> roof{0, 0, 0, 2, 0, 0, 2, 1, 1, 0, 1, 1, 2, 0, 2, 0, 0, 2};
std::vector<double> moved(double ridge, double open) {
  auto v = roof;
  v[7] = v[10] = ridge;
  v[6] += open;
  v[12] += open;
  return v;
}
std::string faces(const std::vector<double>& points, const std::string& more = "creaseAngle 3") {
  return "Shape { appearance Appearance { material Material {} } geometry IndexedFaceSet { solid FALSE " + more +
         " coord DEF P Coordinate { point " + list(points) + " } coordIndex [ 0 1 2 3 -1 3 2 4 5 -1 ] } } ";
}

}  // namespace

TEST_CASE("CoordinateInterpolator is morph targets", "[gltf][animation]") {
  const std::vector<double> key{0, 0.25, 0.6, 1};
  std::vector<double> value;
  for (const auto& v : {moved(1, 0), moved(2.5, 0.5), moved(0.2, -0.5), moved(1, 0)})
    value.insert(value.end(), v.begin(), v.end());
  const Written w = write(faces(roof) + start + "DEF I CoordinateInterpolator { key " + list(key) + " keyValue " +
                          list(value) + " }" + routes("P.set_point"));
  CHECK(w.j["meshes"][0]["primitives"][0]["targets"].size() == 2);  // the first and last key are what the file says
  for (int i = 0; i < n_times; ++i) {
    const auto points = interpolate(key, value, time_of(i));
    const Written still = write(faces(points));
    const auto wanted = still.corners("POSITION", {}),
               got = w.corners("POSITION", w.sample("weights", time_of(i) * cycle));
    REQUIRE(got.size() == wanted.size());
    for (std::size_t k = 0; k < got.size(); ++k) CHECK(got[k] == Approx(wanted[k]).margin(1e-5));
  }
  // Normals are right at the keys, and between them go evenly.
  for (std::size_t k = 0; k < key.size(); ++k) {
    const Written still = write(faces({value.begin() + static_cast<std::ptrdiff_t>(18 * k),
                                       value.begin() + static_cast<std::ptrdiff_t>(18 * k + 18)}));
    const auto wanted = still.corners("NORMAL", {}), got = w.corners("NORMAL", w.sample("weights", key[k] * cycle));
    for (std::size_t c = 0; c < got.size(); ++c) CHECK(got[c] == Approx(wanted[c]).margin(1e-3));
  }
}

TEST_CASE("Flat faces that lie in one plane and move apart have normals of their own", "[gltf][animation]") {
  std::vector<double> flat = roof;
  flat[7] = flat[10] = 0;
  auto value = flat;
  value.insert(value.end(), roof.begin(), roof.end());
  const Written w =
      write(faces(flat, "creaseAngle 0") + start + "DEF I CoordinateInterpolator { key [ 0 1 ] keyValue " +
            list(value) + " }" + routes("P.set_point"));
  const auto wanted = write(faces(roof, "creaseAngle 0")).corners("NORMAL", {}),
             got = w.corners("NORMAL", w.sample("weights", cycle));
  REQUIRE(got.size() == wanted.size());
  for (std::size_t c = 0; c < got.size(); ++c) CHECK(got[c] == Approx(wanted[c]).margin(1e-5));
}

TEST_CASE("Points and normals move together", "[gltf][animation]") {
  const std::string normal = " normal DEF N Normal { vector [ 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1 ] }";
  const std::string turn =
      "DEF J NormalInterpolator { key [ 0 0.4 1 ] keyValue [ 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1, "
      "0 0.5 0.866, 0 0.5 0.866, 0 0.5 0.866, 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1, 0 0 1 ] } ROUTE "
      "C.fraction_changed TO J.set_fraction ROUTE J.value_changed TO N.vector ";
  auto value = roof;
  const auto up = moved(3, 0);
  value.insert(value.end(), up.begin(), up.end());
  const Written w = write(faces(roof, normal) + start + turn + "DEF I CoordinateInterpolator { key [ 0 1 ] keyValue " +
                          list(value) + " }" + routes("P.point"));
  REQUIRE(w.j["animations"][0]["channels"].size() == 1);  // one channel has the weights of both
  for (int i = 0; i < n_times; ++i) {
    const double f = time_of(i);
    const auto weights = w.sample("weights", f * cycle), at = w.corners("POSITION", weights),
               n = w.corners("NORMAL", weights);
    CHECK(at[7] == Approx(1 + 2 * f).margin(1e-5));
    // On the sphere from Z by 30 degrees towards Y: glTF's straight way is within half a degree of it.
    const double angle = std::acos(-1.0) / 6 * (f < 0.4 ? f / 0.4 : (1 - f) / 0.6),
                 length = std::hypot(n[0], n[1], n[2]);
    CHECK(n[1] / length == Approx(std::sin(angle)).margin(0.01));
    CHECK(n[2] / length == Approx(std::cos(angle)).margin(0.01));
  }
}

TEST_CASE("Colours go by hue, saturation and value", "[gltf][animation]") {
  // Hue 350, 10 and 130 degrees; saturation and value as written.
  auto rgb = [](double h, double s, double v) {
    h = std::fmod(h + 360, 360) / 60;
    const double x = v * (1 - s * std::abs(std::fmod(h, 2) - 1)), low = v * (1 - s);
    const std::array<std::array<double, 3>, 6> sectors{
        {{v, x, low}, {x, v, low}, {low, v, x}, {low, x, v}, {x, low, v}, {v, low, x}}};
    return sectors[static_cast<std::size_t>(h)];
  };
  auto at = [&](double f) {
    return f < 0.5 ? rgb(350 + 40 * f, 0.8, 0.9) : rgb(10 + 240 * (f - 0.5), 0.8 - 0.6 * (f - 0.5), 0.9 - (f - 0.5));
  };
  std::vector<double> value;
  for (double f : {0.0, 0.5, 1.0})
    for (double v : at(f)) value.push_back(v);
  const std::string colors = "DEF I ColorInterpolator { key [ 0 0.5 1 ] keyValue " + list(value) + " }";
  const std::string box =
      "Shape { appearance Appearance { material DEF M Material { transparency 0.25 } } geometry Box {} } ";
  auto compare = [&](const Written& w, const std::string& pointer, std::size_t width) {
    for (int i = 0; i < n_times; ++i) {
      const auto got = w.sample(pointer, time_of(i) * cycle);
      REQUIRE(got.size() == width);
      for (std::size_t k = 0; k < 3; ++k) CHECK(got[k] == Approx(linear(at(time_of(i))[k])).margin(2e-3));
      if (width == 4) CHECK(got[3] == Approx(0.75));
    }
  };
  SECTION("diffuseColor") {
    compare(write(box + start + colors + routes("M.set_diffuseColor")),
            "/materials/0/pbrMetallicRoughness/baseColorFactor", 4);
  }
  SECTION("emissiveColor") {
    compare(write(box + start + colors + routes("M.emissiveColor")), "/materials/0/emissiveFactor", 3);
  }
  SECTION("of a light") {
    compare(write(box + "DEF L PointLight {} " + start + colors + routes("L.color")),
            "/extensions/KHR_lights_punctual/lights/0/color", 3);
  }
  SECTION("not asked for") {
    const Written w = write(box + start + colors + routes("M.set_diffuseColor"), false);
    CHECK_FALSE(w.j.contains("animations"));
    CHECK(w.diag.count(Diag::no_gltf_pointer) == 1);
  }
}

TEST_CASE("Numbers of materials, lights and cameras", "[gltf][animation]") {
  const std::string numbers = "DEF I ScalarInterpolator { key [ 0 0.3 1 ] keyValue [ 0.1 0.9 0.5 ] }";
  auto value = [](double f) { return interpolate({0, 0.3, 1}, {0.1, 0.9, 0.5}, f)[0]; };
  auto compare = [&](const std::string& body, const std::string& event, const std::string& pointer, std::size_t k,
                     const std::function<double(double)>& wanted) {
    const Written w = write(body + start + numbers + routes(event));
    for (int i = 0; i < n_times; ++i)
      CHECK(w.sample(pointer, time_of(i) * cycle)[k] == Approx(wanted(value(time_of(i)))).margin(1.5e-3));
  };
  const std::string box =
      "Shape { appearance Appearance { material DEF M Material { diffuseColor 1 0 0 specularColor 1 1 1 } } geometry "
      "Box {} } ";
  SECTION("transparency") {
    compare(box, "M.transparency", "/materials/0/pbrMetallicRoughness/baseColorFactor", 3,
            [](double v) { return 1 - v; });
  }
  SECTION("shininess") {
    compare(box, "M.shininess", "/materials/0/pbrMetallicRoughness/roughnessFactor", 0,
            [](double v) { return std::pow(std::max(2 / (128 * v + 2), 0.01), 0.25); });
  }
  SECTION("intensity") {
    compare(box + "DEF L DirectionalLight { intensity 0 } ", "L.set_intensity",
            "/extensions/KHR_lights_punctual/lights/0/intensity", 0, [](double v) { return std::acos(-1.0) * v; });
  }
  SECTION("fieldOfView") {
    compare(box + "DEF V Viewpoint {} ", "V.fieldOfView", "/cameras/0/perspective/yfov", 0, [](double v) { return v; });
  }
}

TEST_CASE("Interpolators behind one another", "[gltf][animation]") {
  // The inner one goes 0, 1, 0.25: what it drives is passed twice.
  const std::string ease =
      "DEF E ScalarInterpolator { key [ 0 0.5 1 ] keyValue [ 0 1 0.25 ] } ROUTE C.fraction_changed TO E.set_fraction "
      "ROUTE E.value_changed TO I.set_fraction ";
  const std::string way =
      "DEF I PositionInterpolator { key [ 0 0.4 1 ] keyValue [ 0 0 0, 2 1 0, 0 5 1 ] } ROUTE I.value_changed TO "
      "T.set_translation ";
  const Written w = write(
      "DEF T Transform { children Shape { geometry Box {} } } DEF U Transform { children Shape { geometry Sphere {} } "
      "} ROUTE T.translation_changed TO U.set_translation " +
      start + ease + way);
  CHECK(w.j["animations"][0]["channels"].size() == 2);  // U follows T
  for (int i = 0; i < n_times; ++i) {
    const double inner = interpolate({0, 0.5, 1}, {0, 1, 0.25}, time_of(i))[0];
    const auto wanted = interpolate({0, 0.4, 1}, {0, 0, 0, 2, 1, 0, 0, 5, 1}, inner),
               got = w.sample("translation", time_of(i) * cycle);
    for (std::size_t k = 0; k < 3; ++k) CHECK(got[k] == Approx(wanted[k]).margin(1e-5));
  }
}

TEST_CASE("What starts by an event is an animation with a name", "[gltf][animation]") {
  const Written w = write(
      "DEF T Transform { children [ DEF B TouchSensor {} Shape { geometry Box {} } ] } DEF C TimeSensor { "
      "cycleInterval 4 } ROUTE B.touchTime TO C.set_startTime "
      "DEF I PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0, 2 1 0 ] }" +
      routes("T.set_translation"));
  const auto& a = w.j["animations"][0];
  CHECK(a["name"] == "C");
  CHECK(a["extras"]["vrml97"]["loop"] == false);
  CHECK(a["extras"]["vrml97"]["trigger"] == json::array({"B.touchTime TO C.set_startTime"}));
  CHECK(w.diag.count(Diag::no_gltf_trigger) == 1);
}

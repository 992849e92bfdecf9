// Animations there and back: the same place at the same time, by VRML's definition of interpolators and by glTF's.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"
#include "scenegraph/transform.h"
#include "tests/unit/temp_folder.h"
#include "writers/gltf/gltf.h"

using namespace wrlkit;
using json = nlohmann::json;

namespace {

constexpr int n_times = 20;

using Quat = std::array<double, 4>;

Quat quat(const double* r) {
  const double n = std::hypot(r[0], r[1], r[2]), s = n > 0 ? std::sin(r[3] / 2) / n : 0;
  return {r[0] * s, r[1] * s, r[2] * s, n > 0 ? std::cos(r[3] / 2) : 1};
}

Quat slerp(Quat a, Quat b, double t) {
  double c = 0;
  for (int i = 0; i < 4; ++i) c += a[i] * b[i];
  if (c < 0)
    for (double& v : b) v = -v;
  const double angle = std::acos(std::min(std::abs(c), 1.0)),
               wa = angle > 1e-9 ? std::sin((1 - t) * angle) / std::sin(angle) : 1 - t,
               wb = angle > 1e-9 ? std::sin(t * angle) / std::sin(angle) : t;
  Quat o;
  for (int i = 0; i < 4; ++i) o[i] = wa * a[i] + wb * b[i];
  return o;
}

Vec4 axis_angle(const Quat& q) {
  const double n = std::hypot(q[0], q[1], q[2]);
  return n > 0 ? Vec4{q[0] / n, q[1] / n, q[2] / n, 2 * std::atan2(n, q[3])} : Vec4{0, 0, 1, 0};
}

/// ISO/IEC 14772-1, 4.6.8: where a fraction lies among keys, and how far on.
std::pair<std::size_t, double> place(std::span<const double> key, double f) {
  if (f <= key[0]) return {0, 0};
  if (f >= key.back()) return {key.size() - 1, 0};
  std::size_t i = 0;
  while (i + 1 < key.size() && !(key[i] <= f && f < key[i + 1])) ++i;
  return {i, (f - key[i]) / (key[i + 1] - key[i])};
}

/// The scene with every interpolator's value where its ROUTE leads, at a fraction of the cycle.
void set_fraction(Scene& scene, double f) {
  for (const Route& r : scene.main.routes) {
    if (r.event_out != "value_changed") continue;
    const auto slot = scene.type(r.to).find(r.event_in, Dialect::vrml97, true);
    REQUIRE(slot);
    if (scene.is(r.from, nodes::PositionInterpolator)) {
      auto [i, t] = place(scene.get(r.from, nodes::position_interpolator::key), f);
      auto v = scene.get(r.from, nodes::position_interpolator::keyValue);
      Vec3 o;
      for (std::size_t k = 0; k < 3; ++k) o[k] = v[3 * i + k] + (t > 0 ? t * (v[3 * i + 3 + k] - v[3 * i + k]) : 0);
      scene.set(r.to, scene.make(FieldType::SFVec3f, *slot, o));
    } else if (scene.is(r.from, nodes::OrientationInterpolator)) {
      auto [i, t] = place(scene.get(r.from, nodes::orientation_interpolator::key), f);
      auto v = scene.get(r.from, nodes::orientation_interpolator::keyValue);
      const Quat a = quat(&v[4 * i]);
      scene.set(r.to,
                scene.make(FieldType::SFRotation, *slot, axis_angle(t > 0 ? slerp(a, quat(&v[4 * i + 4]), t) : a)));
    }
  }
}

Matrix path_to(const Scene& scene, NodeId from, std::string_view name, bool& found) {
  const Matrix m = local_matrix(scene, from);
  const bool inside = name.empty() || scene.name(from) == name;
  if (scene.is(from, nodes::Shape)) {
    found = inside;
    return m;
  }
  if (scene.is(from, nodes::Transform))
    for (NodeId c : scene.get(from, nodes::transform::children)) {
      const Matrix below = path_to(scene, c, inside ? std::string_view{} : name, found);
      if (found) return m * below;
    }
  return m;
}

Matrix vrml_matrix(const Scene& scene, std::string_view name) {
  for (NodeId n : scene.main.roots) {
    bool found = false;
    const Matrix m = path_to(scene, n, name, found);
    if (found) return m;
  }
  FAIL("no node " << name);
  return {};
}

/// A .gltf with its buffer.
struct File {
  json j;
  std::string bin;

  std::vector<double> numbers(std::size_t accessor) const {
    const auto &a = j["accessors"][accessor], &v = j["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::size_t width = a["type"] == "SCALAR" ? 1
                              : a["type"] == "VEC3" ? 3
                                                    : 4,
                      at = v.value("byteOffset", 0) + a.value("byteOffset", 0);
    std::vector<float> f(a["count"].get<std::size_t>() * width);
    std::memcpy(f.data(), bin.data() + at, f.size() * sizeof(float));
    return {f.begin(), f.end()};
  }

  /// glTF 2.0, appendix C: LINEAR.
  void animate(std::size_t node, double time, Vec3& t, Quat& r, Vec3& s) const {
    for (const auto& animation : j.value("animations", json::array()))
      for (const auto& c : animation["channels"]) {
        if (c["target"]["node"] != node) continue;
        const auto& sampler = animation["samplers"][c["sampler"].get<std::size_t>()];
        auto in = numbers(sampler["input"]), out = numbers(sampler["output"]);
        const std::size_t width = out.size() / in.size();
        std::size_t i = 0;
        while (i + 2 < in.size() && in[i + 1] <= time) ++i;
        const double f = std::clamp((time - in[i]) / (in[i + 1] - in[i]), 0.0, 1.0);
        auto at = [&](std::size_t k) {
          return out[width * i + k] + f * (out[width * (i + 1) + k] - out[width * i + k]);
        };
        if (c["target"]["path"] == "rotation")
          r = slerp({out[4 * i], out[4 * i + 1], out[4 * i + 2], out[4 * i + 3]},
                    {out[4 * i + 4], out[4 * i + 5], out[4 * i + 6], out[4 * i + 7]}, f);
        else
          (c["target"]["path"] == "scale" ? s : t) = {at(0), at(1), at(2)};
      }
  }

  Matrix local(std::size_t node, double time) const {
    const auto& n = j["nodes"][node];
    Vec3 t = n.value("translation", Vec3{0, 0, 0}), s = n.value("scale", Vec3{1, 1, 1});
    Quat r = n.value("rotation", Quat{0, 0, 0, 1});
    animate(node, time, t, r, s);
    return translation_matrix(t) * rotation_matrix(axis_angle(r)) * scale_matrix(s);
  }

  /// The matrix of the mesh that lies at or below the node of that name.
  Matrix world(std::size_t node, std::string_view name, double time, bool inside, bool& found) const {
    const auto& n = j["nodes"][node];
    const Matrix m = local(node, time);
    inside |= n.value("name", "") == name;
    if (inside && n.contains("mesh")) {
      found = true;
      return m;
    }
    for (const auto& c : n.value("children", json::array())) {
      const Matrix below = world(c, name, time, inside, found);
      if (found) return m * below;
    }
    return m;
  }
};

File load(const TempFolder& folder) {
  File f;
  std::ifstream(folder / "a.gltf") >> f.j;
  std::ifstream bin(folder / "a.bin", std::ios::binary);
  f.bin.assign(std::istreambuf_iterator<char>(bin), {});
  return f;
}

std::unique_ptr<World> parse(std::string_view body) {
  Diagnostics diag;
  return parse_world("#VRML V2.0 utf8\n" + std::string(body), "test", {}, diag);
}

bool write(World& world, const TempFolder& folder) {
  Diagnostics diag(world.scene.sources);
  Statistics stats;
  PassContext context{diag, stats};
  std::string why;
  auto pipeline = Pipeline::parse("gltf", why);
  auto meshes = pipeline->run_lazily(world.scene, context);
  return write_gltf(world.scene, meshes, {.binary = false}, nullptr, folder / "a.gltf", diag);
}

/// The node `M` with a Shape is where VRML says, at twenty times that are not keys.
void compare(const std::string& body) {
  TempFolder folder;
  auto world = parse(body);
  REQUIRE(write(*world, folder));
  const File file = load(folder);
  for (int i = 0; i < n_times; ++i) {
    const double f = (i + 0.437) / n_times;
    set_fraction(world->scene, f);
    const Matrix wanted = vrml_matrix(world->scene, "M");
    bool found = false;
    Matrix got;
    for (const auto& root : file.j["scenes"][0]["nodes"]) {
      if (!found) got = file.world(root, "M", f * 4, false, found);
    }
    REQUIRE(found);
    for (std::size_t k = 0; k < 12; ++k) CHECK(got.m[k] == Approx(wanted.m[k]).margin(2e-5));
  }
}

const std::string clock_ = "DEF C TimeSensor { cycleInterval 4 loop TRUE } ";
std::string moving(const std::string& fields, const std::string& interpolator, const std::string& event) {
  return "DEF M Transform { " + fields + " children Shape { geometry Box {} } } " + clock_ + "DEF I " + interpolator +
         " ROUTE C.fraction_changed TO I.set_fraction ROUTE I.value_changed TO M." + event;
}

}  // namespace

TEST_CASE("Interpolators move in glTF what they move in VRML", "[gltf][animation]") {
  const std::string way = "PositionInterpolator { key [0 0.3 1] keyValue [0 0 0, 1 2 3, -4 0 1] }";
  const std::string turn =
      "OrientationInterpolator { key [0 0.25 0.6 1] keyValue [0 1 0 0, 0 1 0 1.5, 1 0 1 2.5, 0 0 1 -0.4] }";
  const std::string grow = "PositionInterpolator { key [0 0.5 1] keyValue [1 1 1, 2 0.5 3, 1 1 1] }";
  SECTION("translation") { compare(moving("scale 2 2 2", way, "set_translation")); }
  SECTION("translation about a center") { compare(moving("center 1 2 3 rotation 0 0 1 1", way, "translation")); }
  SECTION("rotation") { compare(moving("translation 1 0 0", turn, "set_rotation")); }
  SECTION("rotation about a center") { compare(moving("center 1 2 3 scale 1 2 1", turn, "set_rotation")); }
  SECTION("scale along turned axes") { compare(moving("center 1 0 0 scaleOrientation 0 0 1 0.7", grow, "set_scale")); }
  SECTION("half turns") {
    compare(moving("", "OrientationInterpolator { key [0 0.5 1] keyValue [0 1 0 0, 0 1 0 3.14159, 0 1 0 6.28318] }",
                   "rotation"));
  }
  SECTION("a jump") {
    compare(moving("", "PositionInterpolator { key [0 0.5 0.5 1] keyValue [0 0 0, 1 0 0, 5 0 0, 6 0 0] }",
                   "set_translation"));
  }
  SECTION("three equal keys") {
    compare(moving("", "PositionInterpolator { key [0 0.5 0.5 0.5 1] keyValue [0 0 0, 1 0 0, 3 0 0, 5 0 0, 6 0 0] }",
                   "set_translation"));
  }
  SECTION("keys beyond the cycle") {
    compare(moving("", "PositionInterpolator { key [-1 0.5 3] keyValue [0 0 0, 6 0 0, 0 5 0] }", "set_translation"));
  }
  SECTION("keys within it") {
    compare(moving("", "PositionInterpolator { key [0.25 0.5] keyValue [0 0 0, 6 0 0] }", "set_translation"));
  }
  SECTION("through a prototype") {
    compare(
        "PROTO P [] { Transform { rotation 0 1 0 1 children DEF T Transform { children Shape { geometry Box {} } } } "
        "DEF C TimeSensor { cycleInterval 4 } DEF I " +
        way + " ROUTE C.fraction_changed TO I.set_fraction ROUTE I.value_changed TO T.set_translation } DEF M P {}");
  }
}

TEST_CASE("Keys that do not ascend are told", "[gltf][animation]") {
  TempFolder folder;
  auto world =
      parse(moving("", "PositionInterpolator { key [0 1 0.5] keyValue [0 0 0, 1 0 0, 2 0 0] }", "set_translation"));
  REQUIRE(write(*world, folder));
  CHECK_FALSE(load(folder).j.contains("animations"));
}

// A world of one text as the glTF that is written of it, with its JSON and the numbers behind its accessors.
#pragma once
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"
#include "scenegraph/transform.h"
#include "tests/unit/temp_folder.h"
#include "writers/gltf/color.h"
#include "writers/gltf/gltf.h"

namespace wrlkit::gltf_tests {

using json = nlohmann::json;

inline constexpr double pi = std::numbers::pi;

/// Files that exist in the memory of a test.
class Files final : public Resources {
 public:
  std::map<std::string, std::string, std::less<>> files;
  int decoded = 0;

  std::shared_ptr<const Blob> bytes(std::span<const std::string_view> urls, Span, Diagnostics&) override {
    auto f = files.find(urls[0]);
    if (f == files.end()) return nullptr;
    auto& known = blobs_[f->first];
    if (!known)
      known = std::make_shared<Blob>(Blob{f->first.substr(f->first.rfind('/') + 1), f->second, sniff_mime(f->second)});
    return known;
  }
  std::shared_ptr<const Image> image(std::span<const std::string_view> urls, Span where, Diagnostics& diag) override {
    auto blob = bytes(urls, where, diag);
    if (!blob) return nullptr;
    ++decoded;
    std::string error;
    auto image = decode_image(blob->bytes, blob->name, error);
    return image ? std::make_shared<const Image>(std::move(*image)) : nullptr;
  }
  LinkedWorld world(std::span<const std::string_view>, Span, Diagnostics&) override { return {}; }

 private:
  std::map<std::string, std::shared_ptr<const Blob>> blobs_;
};

inline std::uint32_t word(std::string_view s, std::size_t at) {
  std::uint32_t v;
  std::memcpy(&v, s.data() + at, 4);
  return v;
}

/// A world that was converted: its JSON, its binary part, what was reported.
struct Gltf {
  bool written = false;
  std::string bytes, bin;
  json j;
  Diagnostics diag;

  json node(std::string_view name) const {
    for (const auto& n : j["nodes"])
      if (n.value("name", "") == name) return n;
    FAIL("no node " << name);
    return {};
  }
  json mesh_of(std::string_view name) const { return j["meshes"][node(name)["mesh"].get<std::size_t>()]; }
  json primitive(std::string_view name) const { return mesh_of(name)["primitives"][0]; }
  json material(std::string_view name) const { return j["materials"][primitive(name)["material"].get<std::size_t>()]; }
  json view(std::size_t accessor) const {
    return j["bufferViews"][j["accessors"][accessor]["bufferView"].get<std::size_t>()];
  }

  template <class T>
  std::vector<T> values(std::size_t accessor, std::size_t arity) const {
    const auto& a = j["accessors"][accessor];
    std::vector<T> out(a["count"].get<std::size_t>() * arity);
    std::size_t at = view(accessor).value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
    REQUIRE(at % sizeof(T) == 0);
    REQUIRE(at + out.size() * sizeof(T) <= bin.size());
    std::memcpy(out.data(), bin.data() + at, out.size() * sizeof(T));
    return out;
  }
  std::vector<float> attribute(std::string_view node, const char* name, std::size_t arity) const {
    return values<float>(primitive(node)["attributes"].at(name).get<std::size_t>(), arity);
  }
  /// Corners of the triangles of a node's mesh.
  std::vector<std::array<float, 3>> corners(std::string_view node) const {
    auto p = primitive(node);
    auto positions = attribute(node, "POSITION", 3);
    std::vector<std::uint32_t> index;
    if (p.contains("indices")) {
      auto a = p["indices"].get<std::size_t>();
      if (j["accessors"][a]["componentType"] == 5125)
        index = values<std::uint32_t>(a, 1);
      else
        for (auto i : values<std::uint16_t>(a, 1)) index.push_back(i);
    } else {
      for (std::uint32_t i = 0; i < positions.size() / 3; ++i) index.push_back(i);
    }
    std::vector<std::array<float, 3>> out;
    out.reserve(index.size());
    for (auto i : index) out.push_back({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
    return out;
  }
  std::string picture(std::size_t image) const {
    const auto& v = j["bufferViews"][j["images"][image]["bufferView"].get<std::size_t>()];
    return bin.substr(v.value("byteOffset", std::size_t{0}), v["byteLength"].get<std::size_t>());
  }
  std::vector<std::string> messages(Diag id) const {
    std::vector<std::string> out;
    for (const auto& m : diag.messages())
      if (m.id == id) out.push_back(m.text());
    return out;
  }
};

inline std::unique_ptr<World> parse(std::string_view text, Diagnostics& diag) {
  auto world = parse_world("#VRML V2.0 utf8\n" + std::string(text), "test.wrl", {}, diag);
  REQUIRE(world);
  return world;
}

inline bool write(World& world, const GltfOptions& options, Files* files, const std::string& path, Diagnostics& diag) {
  std::string why;
  auto pipeline = Pipeline::parse("tessellate{triangles=false,texcoords=true},normals,triangulate", why);
  REQUIRE(pipeline);
  Statistics stats;
  PassContext context{diag, stats, files};
  auto meshes = pipeline->run_lazily(world.scene, context);
  REQUIRE(meshes);
  return write_gltf(world.scene, meshes, options, files, path, diag);
}

inline Gltf convert(std::string_view text, Files* files = nullptr, GltfOptions options = {}) {
  TempFolder folder;
  Gltf g;
  auto world = parse(text, g.diag);
  g.written = write(*world, options, files, folder / "out.glb", g.diag);
  g.bytes = folder.read("out.glb");
  if (!g.written) return g;
  auto n = word(g.bytes, 12);
  g.j = json::parse(g.bytes.substr(20, n));
  if (g.bytes.size() > 20 + n) g.bin = g.bytes.substr(28 + n);
  return g;
}

/// A triangle in the plane of X and Y, as the geometry of a Shape with that name.
inline std::string triangle(std::string_view name, std::string_view appearance = "", std::string_view fields = "") {
  return "DEF " + std::string(name) + " Shape { " + std::string(appearance) +
         " geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 2 -1] " +
         std::string(fields) + " } }\n";
}

inline std::string with_material(std::string_view material) {
  return "appearance Appearance { material Material { " + std::string(material) + " } }";
}

inline std::string with_picture(std::string_view url,
                                std::string_view material = "material Material { diffuseColor 0.5 0.25 1 }",
                                std::string_view more = "") {
  return "appearance Appearance { " + std::string(material) + " texture ImageTexture { url \"" + std::string(url) +
         "\" " + std::string(more) + "} }";
}

inline std::string png(int channels, std::vector<std::uint8_t> pixels, int width = 1) {
  std::string error;
  int height = static_cast<int>(pixels.size()) / channels / width;
  auto bytes = encode_png({width, height, channels, std::move(pixels)}, error);
  REQUIRE(bytes);
  return *bytes;
}

inline std::vector<double> numbers(const json& j) { return j.get<std::vector<double>>(); }

inline double difference(const Matrix& a, const Matrix& b) {
  double d = 0;
  for (std::size_t i = 0; i < 12; ++i) d = std::max(d, std::abs(a.m[i] - b.m[i]));
  return d;
}

inline float linear(double v) { return static_cast<float>(gltf::linear(v)); }

}  // namespace wrlkit::gltf_tests

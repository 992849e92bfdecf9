// A camera and a studio for tests of pictures: worlds as text, pictures of textures made in memory, single pixels.
#pragma once
#include <catch2/catch.hpp>
#include <map>

#include "light/render/render.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"

namespace wrlkit::render_tests {

/// Pictures by url, made in memory.
struct Pictures : Resources {
  std::map<std::string, std::shared_ptr<const Image>, std::less<>> images;

  std::shared_ptr<const Blob> bytes(std::span<const std::string_view>, Span, Diagnostics&) override { return {}; }
  LinkedWorld world(std::span<const std::string_view>, Span, Diagnostics&) override { return {}; }
  std::shared_ptr<const Image> image(std::span<const std::string_view> urls, Span, Diagnostics&) override {
    if (const MadeFile* made = find_made(urls[0])) return made_image(*made);
    auto i = images.find(urls[0]);
    return i == images.end() ? nullptr : i->second;
  }
  /// What a pass has made.
  static std::shared_ptr<const Image> made_image(const MadeFile& file) {
    std::string fault;
    auto image = decode_image(*file.bytes, file.name, fault);
    REQUIRE(image);
    return std::make_shared<const Image>(std::move(*image));
  }
};

struct Studio {
  Diagnostics diag;
  Statistics stats;
  Pictures pictures;
  RenderOptions options;
  std::string header = "#VRML V2.0 utf8\n";

  Studio() { options.width = options.height = 101; }
  Image render(const std::string& body) {
    auto world = parse_world(header + body, "test.wrl", {}, diag);
    REQUIRE(world);
    std::string why;
    auto pipeline = Pipeline::parse("picture", why);
    PassContext ctx{diag, stats, &pictures};
    auto meshes = pipeline->run_lazily(world->scene, ctx);
    return wrlkit::render(world->scene, meshes, options, &pictures, diag);
  }
};

inline Image render(const std::string& body) { return Studio().render(body); }

using Rgb = std::array<int, 3>;
inline Rgb pixel(const Image& i, int x, int y) {
  const auto* p = i.pixels.data() + (std::size_t(y) * i.width + x) * 3;
  return {p[0], p[1], p[2]};
}
inline Rgb middle(const Image& i) { return pixel(i, i.width / 2, i.height / 2); }

/// How many pixels' worth of white there is in the picture.
inline double area(const Image& i) {
  double sum = 0;
  for (auto p : i.pixels) sum += p;
  return sum / 255 / 3;
}

inline int largest_difference(const Image& a, const Image& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  int most = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
  return most;
}

/// A camera 10 m before the origin that sees 10 m of the plane z = 0: 10 pixels a metre when the picture has 100.
inline const std::string view = "Viewpoint { position 0 0 10 fieldOfView 0.927295218 } ";
inline const std::string dark = "NavigationInfo { headlight FALSE } ";

inline std::string shape(const std::string& geometry, const std::string& material = "", const std::string& more = "") {
  std::string m = material.empty() ? "" : "material Material { " + material + " } ";
  return "Shape { appearance Appearance { " + m + more + " } geometry " + geometry + " } ";
}

/// A rectangle in the plane at depth z, seen from the front.
inline std::string quad(double x0, double y0, double x1, double y1, double z = 0, const std::string& fields = "") {
  auto p = [&](double x, double y) {
    return std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + ", ";
  };
  return "IndexedFaceSet { coord Coordinate { point [ " + p(x0, y0) + p(x1, y0) + p(x1, y1) + p(x0, y1) +
         " ] } coordIndex [ 0 1 2 3 -1 ] " + fields + " } ";
}

inline std::string emitting(const std::string& color) { return "diffuseColor 0 0 0 emissiveColor " + color; }

inline std::string transform(const std::string& fields, const std::string& children) {
  return "Transform { " + fields + " children [ " + children + " ] } ";
}

}  // namespace wrlkit::render_tests

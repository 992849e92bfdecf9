// Light on surfaces as a patch file tells it: triangles of a scene, cut into small triangles ("patches"), each with one
// colour for the radiance that leaves it (Lazanyi, 3.1). The exchange format of global illumination programs.
//
//   <patches version="1" source="room.wrl" unit="m" method="path" samples="256">
//     <shape name="Room/Wall" index="3">
//       <triangle index="0" v="0 0 0 1 0 0 0 1 0">
//         <patch v="0 0 0 0.5 0 0 0 0.5 0" rgb="0.12 0.11 0.1"/>
//         <patch side="back" v="0 0 0 0.5 0 0 0 0.5 0" rgb="0 0 0"/>
//
// v: three corners, world; unit: of v (m, cm, mm, in, ft); rgb: linear radiance, emitted and reflected. Patches may
// also stand directly below the shape or the root; side="back" is the radiance of the side from which the corners run
// clockwise.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/value.h"

namespace wrlkit {

using Corners = std::array<Vec3, 3>;

struct Patch {
  Corners corners{};           // metres of the world, counter-clockwise seen from the front
  std::array<float, 3> rgb{};  // linear radiance
  bool back = false;           // of the other side
};

/// How a file prints coordinates. By as many decimals or as many digits each, it is not known which; so the coarser
/// counts.
struct PrintedDigits {
  int decimals = 17, digits = 17;  // the most of any coordinate
  double unit = 1;                 // metres

  /// What the last digit of a coordinate of that size counts, metres.
  double step(double metres) const {
    const double v = std::fabs(metres) / unit;
    return unit *
           std::max(std::pow(10.0, -decimals), v > 0 ? std::pow(10.0, std::floor(std::log10(v)) + 1 - digits) : 0);
  }
};

/// Three flat lists; what belongs to an entry ends where the next one's begins. 88 bytes a patch.
struct PatchSet {
  static constexpr std::uint32_t unknown = 0xffffffffu;

  struct Shape {
    std::string name;               // DEF names from the root, with '/' between them; may be empty
    std::uint32_t index = unknown;  // of the Shape among those that the world shows
    std::size_t first_triangle = 0;
  };
  /// A triangle of the world. Patches that the file gives without one have a Triangle without index and corners.
  struct Triangle {
    std::uint32_t index = unknown;  // among the triangles of its shape
    bool given = false;             // `corners` are there
    Corners corners{};
    std::size_t first_patch = 0;
  };

  std::string source, method;  // the world's file, what has computed the light
  std::uint32_t samples = 0;
  PrintedDigits printed;  // of the file that it was read from
  std::vector<Shape> shapes;
  std::vector<Triangle> triangles;
  std::vector<Patch> patches;

  std::size_t end_of_shape(std::size_t i) const {
    return i + 1 < shapes.size() ? shapes[i + 1].first_triangle : triangles.size();
  }
  std::size_t end_of_triangle(std::size_t i) const {
    return i + 1 < triangles.size() ? triangles[i + 1].first_patch : patches.size();
  }
  std::span<const Triangle> triangles_of(std::size_t shape) const {
    return std::span(triangles).subspan(shapes[shape].first_triangle,
                                        end_of_shape(shape) - shapes[shape].first_triangle);
  }
  std::span<const Patch> patches_of(std::size_t triangle) const {
    return std::span(patches).subspan(triangles[triangle].first_patch,
                                      end_of_triangle(triangle) - triangles[triangle].first_patch);
  }

  // Entries are added in their order: a shape, its triangles, their patches.
  void add_shape(std::string name, std::uint32_t index) {
    shapes.push_back({std::move(name), index, triangles.size()});
  }
  void add_triangle(std::uint32_t index, const Corners& v) { triangles.push_back({index, true, v, patches.size()}); }
  void add_loose_triangle() { triangles.push_back({unknown, false, {}, patches.size()}); }
};

/// The keywords of the format.
namespace patch_words {
inline constexpr std::string_view patches = "patches", shape = "shape", triangle = "triangle",
                                  patch = "patch",                                                  // elements
    version = "version", source = "source", unit = "unit", method = "method", samples = "samples",  // attributes
    name = "name", index = "index", v = "v", rgb = "rgb", side = "side", front = "front", back = "back";
}  // namespace patch_words

}  // namespace wrlkit

// The one place of the writers that knows Draco: a mesh of triangles as data of KHR_draco_mesh_compression.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace wrlkit::gltf {

struct DracoValues {
  enum class Kind : std::uint8_t { position, normal, color, texcoord, feature };
  Kind kind;
  std::uint32_t width;            // components of each value
  std::span<const float> values;  // one for each vertex
  int bits;  // not of positions: those lie on their grid; nor of features, which are whole numbers up to 65535
};

struct DracoMesh {
  std::string bytes;
  std::uint32_t n_vertices = 0,
                n_corners = 0;  // of what a decoder gives: flat triangles are gone, vertices may be split
};

/// The first of the values are the positions, already on a grid of `step`, and stay there; attributes get their place
/// in the list as their id. `level` from 0 (fast) to 10 (small). Nothing when Draco finds no mesh in it.
std::optional<DracoMesh> draco_pack(std::span<const DracoValues>, std::span<const std::uint32_t> triangles, double step,
                                    int level);

}  // namespace wrlkit::gltf

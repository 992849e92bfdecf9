// KHR_draco_mesh_compression: the one place that knows Draco.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace wrlkit::gltf_reader {

struct DracoAttribute {
  std::uint32_t id = 0;        // as the extension says
  std::uint32_t width = 0;     // components wanted
  std::vector<double> values;  // filled: width for each vertex, as stored (normalised ones as fractions)
};

/// Triangles; fills the attributes. Nothing when the bytes are not a mesh, or an attribute is not in it.
std::optional<std::vector<std::uint32_t>> draco_unpack(std::string_view packed, std::span<DracoAttribute> attributes);

}  // namespace wrlkit::gltf_reader

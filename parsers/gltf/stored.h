// What a glTF file stores, whatever becomes of it: meshes that share their accessors are one.
#pragma once
#include <cstdint>
#include <string_view>

namespace wrlkit {

/// Triangles of what the default scene shows, those of the same indices and points once. The bytes are those of a .glb
/// or .gltf; of anything else, 0.
std::uint64_t stored_triangles(std::string_view gltf);

}  // namespace wrlkit

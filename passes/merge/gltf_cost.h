// What parts take in compressed glTF: bytes, about, by which `merge` decides.
#pragma once

namespace wrlkit::gltf_cost {

constexpr double point = 8, corner = 0.7;  // of vertices that are written once more
constexpr double node = 65;                // in JSON; a placed Shape is two of them
constexpr double mesh = 280;               // with its accessors in JSON
constexpr double table = 600, place = 10;  // of a mesh with a table of its places, and of each of them
constexpr double own_share = 0.4;          // of a mesh's vertices, when what is equal in other meshes is left out

}  // namespace wrlkit::gltf_cost

// The DEF names that a glTF file of wrlkit has, wherever they stand: of nodes, meshes and materials, in extras, in the
// table of parts.
#pragma once
#include <set>
#include <string>
#include <string_view>

namespace wrlkit {

class Diagnostics;

/// The names in the bytes of a .glb or .gltf that lies at a path.
std::set<std::string> names_in_gltf(std::string_view bytes, const std::string& path, Diagnostics&);

}  // namespace wrlkit

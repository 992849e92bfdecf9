// tinygltf as a second judge of .glb files.
#pragma once
#include <string>

namespace wrlkit {

/// What tinygltf says of a .glb: nothing when all is good. Pictures are not decoded.
std::string tinygltf_verdict(const std::string& glb);

}  // namespace wrlkit

// EXT_meshopt_compression: the one place that knows meshoptimizer's decoders.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace wrlkit::gltf_reader {

struct MeshoptView {
  std::string_view mode, filter;
  std::uint64_t count, stride;  // of what comes out; the caller has bounded their product
};

/// False when the bytes are not what they should be.
bool meshopt_unpack(std::string_view packed, const MeshoptView&, std::string& out);

}  // namespace wrlkit::gltf_reader

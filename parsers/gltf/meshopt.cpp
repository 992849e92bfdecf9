#include "parsers/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace wrlkit::gltf_reader {

bool meshopt_unpack(std::string_view packed, const MeshoptView& v, std::string& out) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(packed.data());
  // Filters read groups of four.
  out.assign((v.count + 3) / 4 * 4 * v.stride, '\0');
  const bool indices = v.stride == 2 || v.stride == 4;
  bool good = false;
  if (v.mode == "ATTRIBUTES" && v.stride % 4 == 0)
    good = meshopt_decodeVertexBuffer(out.data(), v.count, v.stride, bytes, packed.size()) == 0;
  else if (v.mode == "TRIANGLES" && indices && v.count % 3 == 0)
    good = meshopt_decodeIndexBuffer(out.data(), v.count, v.stride, bytes, packed.size()) == 0;
  else if (v.mode == "INDICES" && indices)
    good = meshopt_decodeIndexSequence(out.data(), v.count, v.stride, bytes, packed.size()) == 0;
  if (!good) return false;
  if (v.filter == "OCTAHEDRAL" && (v.stride == 4 || v.stride == 8))
    meshopt_decodeFilterOct(out.data(), v.count, v.stride);
  else if (v.filter == "QUATERNION" && v.stride == 8)
    meshopt_decodeFilterQuat(out.data(), v.count, v.stride);
  else if (v.filter == "EXPONENTIAL" && v.stride % 4 == 0)
    meshopt_decodeFilterExp(out.data(), v.count, v.stride);
  else
    good = v.filter == "NONE";
  out.resize(v.count * v.stride);
  return good;
}

}  // namespace wrlkit::gltf_reader

#include "parsers/gltf/draco.h"

#include <draco/compression/decode.h>

#include <exception>

namespace wrlkit::gltf_reader {
namespace {

bool fill(const draco::Mesh& mesh, DracoAttribute& a) {
  const auto* from = mesh.GetAttributeByUniqueId(a.id);
  if (!from || a.width > 4) return false;
  a.values.resize(std::size_t{mesh.num_points()} * a.width);
  float v[4] = {};
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
    if (!from->ConvertValue<float>(from->mapped_index(p), static_cast<std::int8_t>(a.width), v)) return false;
    for (std::uint32_t k = 0; k < a.width; ++k) a.values[std::size_t{p.value()} * a.width + k] = v[k];
  }
  return true;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> draco_unpack(std::string_view packed,
                                                       std::span<DracoAttribute> attributes) try {
  draco::DecoderBuffer buffer;
  buffer.Init(packed.data(), packed.size());
  auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
  if (!type.ok() || type.value() != draco::TRIANGULAR_MESH) return std::nullopt;
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return std::nullopt;
  const draco::Mesh& mesh = *decoded.value();
  for (auto& a : attributes)
    if (!fill(mesh, a)) return std::nullopt;
  std::vector<std::uint32_t> index;
  index.reserve(std::size_t{mesh.num_faces()} * 3);
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) index.push_back(mesh.face(f)[k].value());
  return index;
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace wrlkit::gltf_reader

#include "writers/gltf/draco.h"

#include <draco/compression/encode.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <exception>
#include <unordered_map>

namespace wrlkit::gltf {
namespace {

draco::GeometryAttribute::Type type_of(DracoValues::Kind kind) {
  constexpr draco::GeometryAttribute::Type types[] = {
      draco::GeometryAttribute::POSITION, draco::GeometryAttribute::NORMAL, draco::GeometryAttribute::COLOR,
      draco::GeometryAttribute::TEX_COORD, draco::GeometryAttribute::GENERIC};
  return types[static_cast<std::size_t>(kind)];
}

/// Equal values are one, so that Draco sees which triangles are neighbours across a crease or a seam.
void add(draco::Mesh& mesh, const DracoValues& v) {
  const std::size_t n = v.values.size() / v.width, bytes = v.width * sizeof(float);
  std::unordered_map<std::string_view, std::uint32_t> known;
  std::vector<std::uint32_t> of_vertex(n), first;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::string_view value(reinterpret_cast<const char*>(v.values.data() + std::size_t{i} * v.width), bytes);
    auto [at, is_new] = known.try_emplace(value, static_cast<std::uint32_t>(first.size()));
    if (is_new) first.push_back(i);
    of_vertex[i] = at->second;
  }
  const bool whole = v.kind == DracoValues::Kind::feature;
  draco::GeometryAttribute a;
  a.Init(type_of(v.kind), nullptr, static_cast<std::int8_t>(v.width), whole ? draco::DT_UINT16 : draco::DT_FLOAT32,
         false, static_cast<std::int64_t>(whole ? sizeof(std::uint16_t) : bytes), 0);
  auto* to = mesh.attribute(mesh.AddAttribute(a, false, static_cast<std::uint32_t>(first.size())));
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    const float* value = v.values.data() + std::size_t{first[i]} * v.width;
    const auto number = static_cast<std::uint16_t>(whole ? *value : 0);
    to->SetAttributeValue(draco::AttributeValueIndex(i), whole ? static_cast<const void*>(&number) : value);
  }
  for (std::uint32_t i = 0; i < n; ++i)
    to->SetPointMapEntry(draco::PointIndex(i), draco::AttributeValueIndex(of_vertex[i]));
}

/// The grid of the positions, from their lowest corner: as many bits as the largest extent needs.
void set_grid(draco::Encoder& encoder, std::span<const float> xyz, double step) {
  std::array<float, 3> low{};
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    float high = low[k] = xyz[k];
    for (std::size_t i = k; i < xyz.size(); i += 3) {
      low[k] = std::min(low[k], xyz[i]);
      high = std::max(high, xyz[i]);
    }
    extent = std::max(extent, double{high} - low[k]);
  }
  const auto steps = static_cast<std::uint64_t>(std::llround(extent / step));
  const int bits = std::max(1, static_cast<int>(std::bit_width(steps)));
  encoder.SetAttributeExplicitQuantization(draco::GeometryAttribute::POSITION, bits, 3, low.data(),
                                           static_cast<float>(step * (std::exp2(bits) - 1)));
}

}  // namespace

std::optional<DracoMesh> draco_pack(std::span<const DracoValues> all, std::span<const std::uint32_t> triangles,
                                    double step, int level) try {
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(all[0].values.size() / 3));
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    mesh.AddFace(
        {draco::PointIndex(triangles[i]), draco::PointIndex(triangles[i + 1]), draco::PointIndex(triangles[i + 2])});
  draco::Encoder encoder;
  for (const DracoValues& v : all) {
    add(mesh, v);
    if (v.kind != DracoValues::Kind::position && v.kind != DracoValues::Kind::feature)
      encoder.SetAttributeQuantization(type_of(v.kind), v.bits);
  }
  set_grid(encoder, all[0].values, step);
  encoder.SetSpeedOptions(10 - level, 10 - level);
  encoder.SetTrackEncodedProperties(true);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(mesh, &buffer).ok()) return std::nullopt;
  return DracoMesh{std::string(buffer.data(), buffer.size()), static_cast<std::uint32_t>(encoder.num_encoded_points()),
                   static_cast<std::uint32_t>(encoder.num_encoded_faces() * 3)};
} catch (const std::exception&) {
  return std::nullopt;
}

}  // namespace wrlkit::gltf

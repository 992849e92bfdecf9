// Extensions of glTF that wrlkit knows: the only list of them, for the reader and the writer.
#pragma once
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace wrlkit {

enum class GltfExtension : std::uint8_t {
  animation_pointer,
  lights_punctual,
  materials_unlit,
  texture_transform,
  moz_lightmap,
  instance_features,
  mesh_features,
  structural_metadata,
  lod,
  node_visibility,
  node_selectability,
  node_hoverability,
  interactivity,
  gpu_instancing,
  mesh_quantization,
  meshopt_compression,
  draco_mesh_compression,
  texture_webp,
  khr_meshopt_compression,
  emissive_strength
};

struct GltfExtensionInfo {
  GltfExtension id;
  std::string_view name;
  bool required;  // where it is written, a reader has to know it to show anything
  bool read;      // in files of any program
};

/// In the order in which a file lists them.
inline constexpr GltfExtensionInfo gltf_extensions[] = {
    {GltfExtension::animation_pointer, "KHR_animation_pointer", false, true},
    {GltfExtension::lights_punctual, "KHR_lights_punctual", false, true},
    {GltfExtension::materials_unlit, "KHR_materials_unlit", false, true},
    {GltfExtension::texture_transform, "KHR_texture_transform", false, true},
    {GltfExtension::moz_lightmap, "MOZ_lightmap", false, true},
    {GltfExtension::instance_features, "EXT_instance_features", false, false},
    {GltfExtension::mesh_features, "EXT_mesh_features", false, false},
    {GltfExtension::structural_metadata, "EXT_structural_metadata", false, false},
    {GltfExtension::lod, "MSFT_lod", false, true},
    {GltfExtension::node_visibility, "KHR_node_visibility", false, true},
    {GltfExtension::node_selectability, "KHR_node_selectability", false, false},
    {GltfExtension::node_hoverability, "KHR_node_hoverability", false, false},
    {GltfExtension::interactivity, "KHR_interactivity", false, false},
    {GltfExtension::gpu_instancing, "EXT_mesh_gpu_instancing", true, true},
    {GltfExtension::mesh_quantization, "KHR_mesh_quantization", true, true},
    {GltfExtension::meshopt_compression, "EXT_meshopt_compression", true, true},
    {GltfExtension::draco_mesh_compression, "KHR_draco_mesh_compression", true, true},
    {GltfExtension::texture_webp, "EXT_texture_webp", true, true},
    {GltfExtension::khr_meshopt_compression, "KHR_meshopt_compression", true, true},
    {GltfExtension::emissive_strength, "KHR_materials_emissive_strength", false, true}};

constexpr std::string_view gltf_extension_name(GltfExtension id) {
  return std::ranges::find(gltf_extensions, id, &GltfExtensionInfo::id)->name;
}

constexpr bool knows_gltf_extension(std::string_view name) {
  return std::ranges::find(gltf_extensions, name, &GltfExtensionInfo::name) != std::end(gltf_extensions);
}

constexpr bool reads_gltf_extension(std::string_view name) {
  const auto* at = std::ranges::find(gltf_extensions, name, &GltfExtensionInfo::name);
  return at != std::end(gltf_extensions) && at->read;
}

}  // namespace wrlkit

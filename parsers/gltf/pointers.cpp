#include "parsers/gltf/pointers.h"

#include <charconv>
#include <numbers>

#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {
namespace {

/// "/a/3/b" with "/a/" and "/b" around the number.
std::optional<std::uint32_t> number_between(std::string_view s, std::string_view before, std::string_view after) {
  if (!s.starts_with(before)) return std::nullopt;
  s.remove_prefix(before.size());
  std::uint32_t n = 0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), n);
  if (error != std::errc() || s.substr(static_cast<std::size_t>(end - s.data())) != after) return std::nullopt;
  return n;
}

constexpr std::string_view lights = "/extensions/KHR_lights_punctual/lights/";

}  // namespace

std::optional<std::pair<std::uint32_t, std::string_view>> node_path(std::string_view pointer) {
  for (std::string_view path : {"translation", "rotation", "scale", "weights"})
    if (auto n = number_between(pointer, "/nodes/", "/" + std::string(path))) return std::pair(*n, path);
  return std::nullopt;
}

Pointed followers_of(const Context& c, const Hierarchy& hierarchy, const Meshes& meshes, std::string_view pointer) {
  Pointed out;
  const Scene& scene = c.scene;
  if (auto n = number_between(pointer, "/materials/", "/pbrMetallicRoughness/baseColorFactor")) {
    const bool unlit = bool(c.file.at(Table::materials, *n)["extensions"]["KHR_materials_unlit"]);
    out.width = 4;
    for (const auto& [material, faces] : meshes.materials_of(*n)) {
      out.followers.push_back({material, unlit || !faces ? "set_emissiveColor" : "set_diffuseColor", true});
      out.followers.push_back({material, "set_transparency", false, 3, -1, 1});
    }
  } else if (auto e = number_between(pointer, "/materials/", "/emissiveFactor")) {
    out.width = 3;
    for (const auto& [material, faces] : meshes.materials_of(*e))
      if (faces) out.followers.push_back({material, "set_emissiveColor", true});
  } else if (auto color = number_between(pointer, lights, "/color")) {
    out.width = 3;
    for (NodeId l : hierarchy.lights(*color)) out.followers.push_back({l, "set_color", true});
  } else if (auto intensity = number_between(pointer, lights, "/intensity")) {
    out.width = 1;
    const double now = c.file.at(Table::lights, *intensity)["intensity"].number(1);
    for (NodeId l : hierarchy.lights(*intensity))
      if (const bool sun = scene.is(l, nodes::DirectionalLight); sun || now > 0)
        out.followers.push_back({l, "set_intensity", false, 0, sun ? 1 / std::numbers::pi : 1 / now});
  } else if (auto camera = number_between(pointer, "/cameras/", "/perspective/yfov")) {
    out.width = 1;
    for (NodeId v : hierarchy.cameras(*camera)) out.followers.push_back({v, "set_fieldOfView"});
  }
  return out;
}

}  // namespace wrlkit::gltf_reader

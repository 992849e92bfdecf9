#include "writers/gltf/json/json.h"

#include <algorithm>

#include "scenegraph/gltf_extensions.h"
#include "writers/gltf/json/lists.h"

namespace wrlkit::gltf {
namespace {

class Writer {
 public:
  Writer(const Parts& parts, const Sink& sink) : p_(parts), d_(parts.document), sink_(sink) {}

  std::vector<GltfSummary::Share> write() {
    json_.begin_object();
    write_asset(json_, p_);
    extensions();
    write_extensions(json_, p_);
    json_.member("scene", 0);
    list("scenes", 1, [&](std::size_t) { write_scene(json_, p_); });
    measured("nodes", d_.nodes.size(), write_node);
    const auto visible = visibility(p_.scene, d_.navigation_info);
    measured("cameras", d_.cameras.size(), [&](JsonOut& json, const Parts& p, std::size_t i) {
      const Camera& camera = d_.cameras[i];
      const double reach = d_.sky ? d_.sky->radius + length(camera.position - d_.sky->centre) : 0;
      write_camera(json, p.scene, camera, d_.world, visible, reach);
    });
    measured("meshes", p_.meshes.meshes().size(), write_mesh);
    const auto& materials = p_.materials.materials();
    measured("materials", materials.size(),
             [&](JsonOut& json, const Parts&, std::size_t i) { json.raw(materials[i]); });
    measured("textures", p_.textures.textures().size(), write_texture);
    measured("images", p_.textures.pictures().size(), write_image);
    measured("samplers", p_.textures.samplers().size(), write_sampler);
    measured("animations", p_.animations.count(), [](JsonOut& json, const Parts& p, std::size_t i) {
      p.animations.write(json, i, p.facts_only ? nullptr : p.extras, [&](std::uint32_t a) { return p.packing.of(a); });
    });
    measured("accessors", p_.packing.store().accessors().size(), write_accessor);
    measured("bufferViews", p_.layout.views().size(), write_buffer_view);
    list("buffers", (p_.layout.size() > 0) + (p_.layout.unpacked_size() > 0),
         [&](std::size_t i) { write_buffer(json_, p_, i); });
    json_.end_object();
    sink_(text_);
    return std::move(shares_);
  }

 private:
  /// An array; glTF allows no empty ones.
  template <class F>
  void list(std::string_view name, std::size_t n, F element) {
    constexpr std::size_t piece = 128 * 1024;
    if (n == 0) return;
    json_.key(name);
    json_.begin_array();
    for (std::size_t i = 0; i < n; ++i) {
      element(i);
      if (text_.size() < piece) continue;
      sink_(text_);
      written_ += text_.size();
      text_.clear();
    }
    json_.end_array();
  }

  /// The same, one of the whole file.
  template <class F>
  void measured(std::string_view name, std::size_t n, F element) {
    const auto before = written_ + text_.size();
    list(name, n, [&](std::size_t i) { element(json_, p_, static_cast<std::uint32_t>(i)); });
    if (n > 0) shares_.emplace_back(name, written_ + text_.size() - before);
  }

  /// What a reader must know to see anything is both used and required.
  void extensions() {
    std::vector<std::string_view> used, required;
    for (const auto& e : gltf_extensions)
      if (uses(e.id)) (e.required ? required : used).push_back(e.name);
    used.insert(used.end(), required.begin(), required.end());
    list("extensionsUsed", used.size(), [&](std::size_t i) { json_.value(used[i]); });
    list("extensionsRequired", required.size(), [&](std::size_t i) { json_.value(required[i]); });
  }

  bool uses(GltfExtension e) const {
    using enum GltfExtension;
    switch (e) {
      case animation_pointer:
        return p_.animations.uses_pointers();
      case lights_punctual:
        return !d_.lights.empty();
      case materials_unlit:
        return p_.materials.uses_unlit();
      case texture_transform:
        return p_.materials.uses_texture_transform();
      case moz_lightmap:
        return p_.materials.uses_moz_lightmap();
      case instance_features:
        return std::ranges::any_of(d_.instances, [](const Instances& i) { return i.features != none; });
      case mesh_features:
        return p_.meshes.any_features();
      case structural_metadata:
        return p_.has_table();
      case lod:
        return !d_.lods.empty();
      case node_visibility:
        return std::ranges::any_of(d_.nodes, &Node::hidden) || p_.graph.uses(e);
      case node_selectability:
      case node_hoverability:
      case interactivity:
        return p_.graph.uses(e);
      case gpu_instancing:
        return !d_.instances.empty();
      case mesh_quantization:
        return p_.packing.uses_quantization();
      case meshopt_compression:
        return p_.layout.unpacked_size() > 0;
      case draco_mesh_compression:
        return !p_.packing.blobs().empty();
      case texture_webp:
        return p_.textures.uses_webp();
      case khr_meshopt_compression:
      case emissive_strength:
        break;
    }
    return false;
  }

  const Parts& p_;
  const Document& d_;
  const Sink& sink_;
  std::string text_;
  std::uint64_t written_ = 0;
  std::vector<GltfSummary::Share> shares_;
  JsonOut json_{text_};
};

}  // namespace

std::vector<GltfSummary::Share> write_json(const Parts& parts, const Sink& sink) { return Writer(parts, sink).write(); }

}  // namespace wrlkit::gltf

#include "convert/tinygltf/tinygltf.h"

// Compiled here, with the options that the target passes on: the classes of Debian's library were found to be laid out
// otherwise.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "passes/pipeline/pipeline.h"

namespace wrlkit {
namespace {

constexpr const char* model_name = "the tinygltf model";

std::string_view pipeline_of(GltfOptions::Lightmaps lightmaps) {
  switch (lightmaps) {
    case GltfOptions::Lightmaps::base_color:
      return "gltf";
    case GltfOptions::Lightmaps::emissive:
      return "gltf-emissive";
    default:
      return "gltf-light";
  }
}

/// The bytes of a picture file stay what they are.
bool keep_bytes(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
                void*) {
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

std::optional<std::string> glb_of(const Scene& scene, const GltfOptions& options, Resources* resources,
                                  Diagnostics& diag) {
  Scene copy = scene;
  Statistics stats;
  PassContext context{diag, stats, resources};
  std::string why, bytes;
  auto pipeline = Pipeline::parse(std::string(pipeline_of(options.lightmaps)), why);
  const auto meshes = pipeline->run_lazily(copy, context);
  auto take = [&](std::string_view block) { bytes += block; };
  if (!meshes || !write_glb(copy, meshes, options, resources, take, diag)) return std::nullopt;
  return bytes;
}

using Json = nlohmann::ordered_json;

/// What is left of a value in tinygltf: nothing of null, nothing of what is empty, 32 bits of an integer.
Json as_tinygltf_has_it(const Json& value) {
  if (value.is_number_integer()) return static_cast<int>(value.get<std::int64_t>());
  if (!value.is_structured()) return value;
  Json kept;
  for (const auto& [key, member] : value.items()) {
    Json left = as_tinygltf_has_it(member);
    if (left.is_null()) continue;
    if (value.is_array())
      kept.push_back(std::move(left));
    else
      kept[key] = std::move(left);
  }
  return kept;
}

/// The same for `extensions`, of which each is kept as an object even if it is empty.
Json extensions_as_tinygltf_has_them(const Json& value) {
  Json kept = Json::object();
  for (const auto& [key, extension] : value.items()) {
    Json left = as_tinygltf_has_it(extension);
    kept[key] = left.is_null() ? Json::object() : std::move(left);
  }
  return kept;
}

/// Members in any order.
bool is_same(const Json& a, const Json& b) { return nlohmann::json(a) == nlohmann::json(b); }

/// Gives an element of the JSON that tinygltf has written its extras and extensions back as they were before it read
/// them, where they have not been changed since.
template <class Element>
void restore(Json& json, const Element& element) {
  if (!element.extras_json_string.empty()) {
    Json original = Json::parse(element.extras_json_string, nullptr, false);
    const auto now = json.contains("extras") ? json["extras"] : Json();
    if (!original.is_discarded() && is_same(as_tinygltf_has_it(original), now)) json["extras"] = std::move(original);
  }
  if (!element.extensions_json_string.empty()) {
    Json original = Json::parse(element.extensions_json_string, nullptr, false);
    const auto now = json.contains("extensions") ? json["extensions"] : Json::object();
    if (original.is_object() && is_same(extensions_as_tinygltf_has_them(original), now))
      json["extensions"] = std::move(original);
  }
}

template <class Elements, class Inner>
void restore_all(Json& json, const char* name, const Elements& elements, Inner inner) {
  if (!json.contains(name) || json[name].size() != elements.size()) return;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    restore(json[name][i], elements[i]);
    inner(json[name][i], elements[i]);
  }
}

template <class Elements>
void restore_all(Json& json, const char* name, const Elements& elements) {
  restore_all(json, name, elements, [](Json&, const auto&) {});
}

/// The same of a member that is an element itself: the texture of a material, with its KHR_texture_transform.
template <class Element>
void restore_member(Json& json, const char* name, const Element& element) {
  if (json.contains(name)) restore(json[name], element);
}

void restore_inside(Json& json, const tinygltf::Material& material) {
  restore_member(json, "normalTexture", material.normalTexture);
  restore_member(json, "occlusionTexture", material.occlusionTexture);
  restore_member(json, "emissiveTexture", material.emissiveTexture);
  if (!json.contains("pbrMetallicRoughness")) return;
  const auto& pbr = material.pbrMetallicRoughness;
  restore_member(json, "pbrMetallicRoughness", pbr);
  restore_member(json["pbrMetallicRoughness"], "baseColorTexture", pbr.baseColorTexture);
  restore_member(json["pbrMetallicRoughness"], "metallicRoughnessTexture", pbr.metallicRoughnessTexture);
}

void restore(Json& json, const tinygltf::Model& model) {
  restore<tinygltf::Model>(json, model);
  restore(json["asset"], model.asset);
  restore_all(json, "accessors", model.accessors);
  restore_all(json, "buffers", model.buffers);
  restore_all(json, "bufferViews", model.bufferViews);
  restore_all(json, "cameras", model.cameras);
  restore_all(json, "images", model.images);
  restore_all(json, "materials", model.materials, restore_inside);
  restore_all(json, "nodes", model.nodes);
  restore_all(json, "samplers", model.samplers);
  restore_all(json, "scenes", model.scenes);
  restore_all(json, "textures", model.textures);
  restore_all(json, "meshes", model.meshes,
              [](Json& mesh, const auto& of) { restore_all(mesh, "primitives", of.primitives); });
  restore_all(json, "animations", model.animations, [](Json& animation, const auto& of) {
    restore_all(animation, "channels", of.channels);
    restore_all(animation, "samplers", of.samplers);
  });
}

constexpr std::size_t glb_header = 12, chunk_header = 8;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
  return word;
}

void set_word(std::string& bytes, std::size_t at, std::size_t word) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(word >> 8 * i);
}

/// A .glb of tinygltf's with what it dropped of extras and extensions.
std::string restored(const std::string& glb, const tinygltf::Model& model) {
  const std::size_t length = word_at(glb, glb_header);
  Json json = Json::parse(std::string_view(glb).substr(glb_header + chunk_header, length));
  restore(json, model);
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string out = glb.substr(0, glb_header + chunk_header);
  out += text;
  out += glb.substr(glb_header + chunk_header + length);
  set_word(out, 8, out.size());
  set_word(out, glb_header, text.size());
  return out;
}

}  // namespace

std::optional<tinygltf::Model> to_tinygltf(const Scene& scene, const GltfOptions& options, Resources* resources,
                                           Diagnostics& diag) {
  const auto bytes = glb_of(scene, options, resources, diag);
  if (!bytes) return std::nullopt;
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_bytes, nullptr);
  loader.SetStoreOriginalJSONForExtrasAndExtensions(true);
  tinygltf::Model model;
  std::string error, warning;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes->data());
  if (!loader.LoadBinaryFromMemory(&model, &error, &warning, data, static_cast<unsigned>(bytes->size()))) {
    diag.report(Diag::cannot_read, Span{}, model_name, error);
    return std::nullopt;
  }
  return model;
}

std::unique_ptr<World> from_tinygltf(const tinygltf::Model& model, const ReadOptions& options, Diagnostics& diag) {
  std::ostringstream out;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, out, false, true)) {
    diag.report(Diag::cannot_write, Span{}, model_name, "tinygltf refuses it");
    return nullptr;
  }
  return parse_world(restored(out.str(), model), model_name, options, diag);
}

}  // namespace wrlkit

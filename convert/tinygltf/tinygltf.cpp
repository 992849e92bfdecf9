#include "convert/tinygltf/tinygltf.h"

#include <tiny_gltf.h>

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
  return parse_world(out.view(), model_name, options, diag);
}

}  // namespace wrlkit

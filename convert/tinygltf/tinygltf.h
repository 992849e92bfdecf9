// Scenes as a model of tinygltf, and back: the component wrlkit::tinygltf. Programs that hold glTF as a
// tinygltf::Model need no file between it and wrlkit.
//
//   auto model = to_tinygltf(world->scene, {}, &resources, diag);   // as `convert` would write it
//   model->materials[0].pbrMetallicRoughness.roughnessFactor = 0.5;
//   auto back = from_tinygltf(*model, {}, diag);                    // as `convert` would read it
#pragma once
#include <memory>
#include <optional>

#include "parsers/parsers.h"
#include "writers/gltf/gltf.h"

namespace tinygltf {
class Model;
}

namespace wrlkit {

/// What `convert` writes as .glb, with nodes, meshes, materials, lights, animations, extras and extensions. Pictures
/// stay as they are stored: the bytes of a PNG, say, in Image::image, with as_is set. The scene is not changed; the
/// pipelines gltf, gltf-emissive or gltf-light run over a copy, as options.lightmaps asks. Nothing when it cannot be
/// written, or when tinygltf cannot read it; both are reported. Goes through the bytes of the file in memory: twice the
/// size of the file on top of the model.
std::optional<tinygltf::Model> to_tinygltf(const Scene&, const GltfOptions&, Resources*, Diagnostics&);

/// What the reader makes of the model, written as .glb by tinygltf. Null when no scene can be read;
/// why is in the diagnostics. Pictures must be bytes of a picture file, in a bufferView or with as_is, or have a uri;
/// pixels (what tinygltf makes when nobody sets an image loader) are written as PNG. Goes through the bytes of the file
/// in memory.
///
/// Of extras and unknown extensions, a model holds less than the file does: tinygltf 2.7 drops empty objects, empty
/// arrays and null, sorts the members of objects by name and cuts integers to 32 bits. Where it was loaded with
/// SetStoreOriginalJSONForExtrasAndExtensions, as to_tinygltf does, extras that have not changed since are taken
/// from there, without loss.
std::unique_ptr<World> from_tinygltf(const tinygltf::Model&, const ReadOptions&, Diagnostics&);

}  // namespace wrlkit

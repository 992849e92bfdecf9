// Elements of the lists of a file, and its scene, each as one JSON object.
#pragma once
#include "base/text/json.h"
#include "writers/gltf/json/json.h"

namespace wrlkit::gltf {

void write_scene(JsonOut&, const Parts&);
void write_node(JsonOut&, const Parts&, std::uint32_t node);
void write_mesh(JsonOut&, const Parts&, std::uint32_t mesh);
void write_texture(JsonOut&, const Parts&, std::size_t);
void write_image(JsonOut&, const Parts&, std::size_t);
void write_sampler(JsonOut&, const Parts&, std::size_t);
void write_accessor(JsonOut&, const Parts&, std::size_t);
void write_buffer_view(JsonOut&, const Parts&, std::size_t);
/// The first one is what is stored, the second what EXT_meshopt_compression makes of it.
void write_buffer(JsonOut&, const Parts&, std::size_t);
/// The members asset and extensions of a file, without those that are empty.
void write_asset(JsonOut&, const Parts&);
void write_extensions(JsonOut&, const Parts&);

}  // namespace wrlkit::gltf

#include "convert/options.h"

namespace wrlkit {

GltfOptions gltf_options(const SaveOptions& o, bool binary) {
  return {.binary = binary,
          .lightmaps = o.lightmap_as,
          .compression = {.method = o.compress,
                          .tolerance = o.tolerance.metres,
                          .position_bits = o.position_bits,
                          .normal_bits = o.normal_bits,
                          .texcoord_bits = o.texcoord_bits,
                          .color_bits = o.color_bits,
                          .level = o.draco_level},
          .textures = {o.texture_format, o.texture_quality, o.texture_size},
          .measure_gzip = o.measure_gzip,
          .origin = o.origin,
          .animation_pointer = o.animation_pointer,
          .names = o.names,
          .gpu_instancing = o.gpu_instancing,
          .own_folder = o.own_folder,
          .extras = o.extras != Extras::none,
          .facts_only = o.names == GltfOptions::Names::table || o.extras != Extras::all,
          .hidden = o.hidden,
          .behaviour = o.behaviour};
}

}  // namespace wrlkit

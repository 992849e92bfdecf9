// Textures: which picture, repeated or not. ImageTexture and PixelTexture become textures of glTF; each picture is
// stored once, whoever uses it. MovieTexture has no counterpart.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "scenegraph/looks/texture_sampler.h"
#include "scenegraph/resources.h"
#include "writers/gltf/images.h"
#include "writers/gltf/recoding.h"
#include "writers/gltf/store.h"

namespace wrlkit::gltf {

struct Picture {
  std::string name;  // of the file, with the extension of what the bytes are
  std::string_view mime;
  std::string_view bytes;
  std::shared_ptr<const void> owner;  // of the bytes

  bool is_webp() const { return mime == "image/webp"; }
};

struct Texture {
  std::uint32_t picture = none, sampler = none;
  NodeId source;
};

/// What a material must know of a texture.
struct TextureUse {
  std::uint32_t texture = none;  // none: there is nothing to show
  int channels = 0;              // the number that the lighting model asks for (ISO/IEC 14772-1, 4.14)
  Alpha alpha = Alpha::opaque;
};

/// Slots of a texture node that its texture, picture and sampler say.
std::span<const std::uint16_t> said_by_texture(const Scene&, NodeId);

class Textures {
 public:
  Textures(const Scene& scene, Resources* resources, const GltfTextures& options, Diagnostics& diag)
      : scene_(scene), resources_(resources), options_(options), diag_(diag) {}

  /// For an ImageTexture, PixelTexture or MovieTexture; equal ones are one texture. What is missing is reported,
  /// once.
  TextureUse get(NodeId texture, PixelMeaning = PixelMeaning::color);
  /// A grey picture of how bright the light of a lightmap is: linear, times `scale`, cut at 1.
  TextureUse brightness(NodeId lightmap, double scale);

  const std::vector<Picture>& pictures() const { return pictures_; }
  const std::vector<Texture>& textures() const { return textures_; }
  const std::vector<TextureSampler>& samplers() const { return samplers_; }
  bool uses_webp() const;
  const GltfSummary::Recoding& recoding() const { return recoding_; }

 private:
  struct Loaded {
    std::uint32_t picture = none;
    int channels = 0;
    Alpha alpha = Alpha::opaque;
  };
  TextureUse make(NodeId, PixelMeaning);
  TextureUse make(NodeId, const Loaded&, TextureSampler);
  Loaded load_file(NodeId, PixelMeaning);
  std::shared_ptr<const Image> image(NodeId);
  Loaded load_pixels(NodeId, PixelMeaning);
  Loaded stored(NodeId, const std::string& name, const Image&, PixelMeaning, std::size_t bytes = 0,
                std::optional<Picture> plain = {});
  std::uint32_t add(Picture);

  const Scene& scene_;
  Resources* resources_;
  const GltfTextures& options_;
  Diagnostics& diag_;
  std::map<std::pair<std::uint32_t, PixelMeaning>, TextureUse> by_node_;
  std::map<std::pair<std::uint32_t, double>, TextureUse> brightness_;
  std::map<std::pair<std::shared_ptr<const Blob>, PixelMeaning>, Loaded>
      by_file_;  // keeps them, so that none takes the place of another
  std::unordered_map<std::string_view, std::uint32_t> by_bytes_;
  std::vector<Picture> pictures_;
  std::vector<Texture> textures_;
  std::vector<TextureSampler> samplers_;
  GltfSummary::Recoding recoding_;
};

}  // namespace wrlkit::gltf

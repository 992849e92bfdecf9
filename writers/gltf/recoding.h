// Pictures encoded again, smaller.
//
// - Lossy formats are for colours: pictures of normals, roughness and the like keep their format and only become
// smaller.
// - JPEG has no alpha: a picture that is clear somewhere keeps its format. WebP has no grey, which to VRML is something
// else than
//   colours: grey pictures become JPEG instead, or keep their format if they have alpha.
// - A picture that would not get smaller stays as it is, unless its size was to change.
// - WebP stands alone (EXT_texture_webp, required): a second picture for viewers that do not know it would take more
// than
//   what WebP saves. For those there is JPEG.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "base/image/image_resize.h"
#include "writers/gltf/gltf.h"

namespace wrlkit::gltf {

/// The file of a picture; without a type: it is none that glTF takes as it is.
struct PlainFile {
  std::string_view mime;
  std::size_t bytes = 0;
};

struct Recoded {
  std::string bytes;
  std::string_view mime;
  bool resized = false;
  double psnr = 0;  // dB; 0: nothing is lost but by another size
};

/// Whether the pixels of such a picture are needed to know how it is stored.
bool may_recode(const GltfTextures&, const PlainFile&, int width, int height);

/// Nothing, and no error: the plain file is as it should be. Nothing and an error: the codec has failed.
std::optional<Recoded> recoded(const Image&, PixelMeaning, const PlainFile&, const GltfTextures&, std::string& error);

}  // namespace wrlkit::gltf

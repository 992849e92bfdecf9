// Pictures as glTF takes them: PNG or JPEG files, without what its readers would have to ignore.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "base/image/image.h"

namespace wrlkit::gltf {

/// How a picture file becomes part of a glTF file.
struct PortableImage {
  bool usable = false;                 // false: it must be decoded and encoded again
  std::optional<std::string> cleaned;  // present when chunks had to be left out; otherwise the file is good as it is
};

/// A PNG loses a colour profile, a gamma or a pixel ratio that glTF says to ignore (3.8.3 of its specification); its
/// pixels stay as they are. A JPEG must have one or three channels: CMYK is not allowed. Damaged files are not usable.
PortableImage portable_image(std::string_view bytes, std::string_view mime);

enum class Alpha : std::uint8_t { opaque, mask, blend };
/// mask: each pixel is either there or not.
Alpha alpha_of(const Image&);

}  // namespace wrlkit::gltf

#include "passes/picture_format/picture_format.h"

#include <algorithm>

#include "base/image/image.h"

namespace wrlkit {

bool PictureFormat::read(std::string_view text) {
  static constexpr std::string_view formats[] = {"png", "jpg", "webp"};
  value = text;
  return std::ranges::count(formats, text) && can_encode_as("." + value);
}

}  // namespace wrlkit

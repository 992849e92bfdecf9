#include "passes/picture_format/picture_format.h"

#include "base/image/image.h"

namespace wrlkit {

std::string why_missing(PictureFormat format) {
  const std::string name(name_of(format));
  return can_encode_as("." + name) ? "" : "this wrlkit was built without a writer of " + name + " pictures";
}

}  // namespace wrlkit

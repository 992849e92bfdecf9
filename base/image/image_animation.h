// Pictures one after another as one file: an animated WebP.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/image/image.h"

namespace wrlkit {

class PictureAnimation {
 public:
  virtual ~PictureAnimation() = default;
  /// The next picture; all have the size of the first. False, and why, when it cannot be taken.
  virtual bool add(const Image&, std::string& error) = 0;
  /// The file, which plays without end.
  virtual std::optional<std::string> finish(std::string& error) = 0;
};

/// Each picture is shown for that many milliseconds. Losses are not seen (encode_as). The same bytes for the same
/// pictures. Null, and why, when this program was built without libwebpmux.
std::unique_ptr<PictureAnimation> begin_webp_animation(int milliseconds, std::string& error);

}  // namespace wrlkit

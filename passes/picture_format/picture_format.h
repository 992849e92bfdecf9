// The file format of pictures that a pass makes, as an option: format=png.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

struct PictureFormat {
  static constexpr std::string_view type = "png, jpg or webp";
  std::string value = "png";

  /// False also for a format that this build cannot write.
  bool read(std::string_view text);
  std::string print() const { return value; }
};

}  // namespace wrlkit

// Pictures side by side in one, with names below them. Names are drawn as VRML draws a Text node.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/image/image.h"

namespace wrlkit {

/// Copies an RGB picture into another one, where it must have room; x and y are of its upper left corner.
void put(Image& sheet, const Image& picture, int x, int y);

/// An RGB picture of one grey.
Image plain_picture(int width, int height, std::uint8_t grey);

/// A line of text, dark on white, in the middle of a picture of that size; long ones are drawn narrower. Without a font
/// it is white.
Image text_picture(std::string_view text, int width, int height);

struct NamedPicture {
  std::string name;
  Image picture;
};

struct GridSize {
  int columns = 1, rows = 1, width = 1, height = 1;  // pixels
};
/// For that many pictures of one size.
GridSize grid_size(std::size_t n, int columns, int width, int height);

/// Pictures of one size, in rows from the left, white around them, the name of each below it.
Image picture_grid(const std::vector<NamedPicture>& pictures, int columns);

}  // namespace wrlkit

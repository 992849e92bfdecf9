#include "base/image/image_resize.h"

#include <catch2/catch.hpp>

using namespace wrlkit;

namespace {

Image checker(int side, int channels, std::vector<std::uint8_t> even, std::vector<std::uint8_t> odd) {
  Image image{side, side, channels, {}};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto& p = (x + y) % 2 ? odd : even;
      image.pixels.insert(image.pixels.end(), p.begin(), p.end());
    }
  return image;
}

/// All pixels but those near the rim, where the kernel is cut.
bool all_near(const Image& image, const std::vector<int>& expected, int slack) {
  for (int y = 4; y < image.height - 4; ++y)
    for (int x = 4; x < image.width - 4; ++x)
      for (int c = 0; c < image.channels; ++c)
        if (std::abs(image.pixels[static_cast<std::size_t>((y * image.width + x) * image.channels + c)] -
                     expected[static_cast<std::size_t>(c)]) > slack)
          return false;
  return true;
}

}  // namespace

TEST_CASE("smaller pictures are as bright as the large ones") {
  // Half of the light of white is 188 in sRGB (IEC 61966-2-1), the mean of numbers is 128.
  const auto fine = checker(64, 1, {0}, {255});
  CHECK(all_near(resized(fine, {16, 16}, PixelMeaning::color), {188}, 2));
  CHECK(all_near(resized(fine, {16, 16}, PixelMeaning::data), {128}, 2));
}

TEST_CASE("what is clear gives no colour to what is not") {
  const auto image = checker(64, 4, {200, 100, 50, 255}, {0, 255, 0, 0});
  CHECK(all_near(resized(image, {20, 20}, PixelMeaning::color), {200, 100, 50, 128}, 2));
}

TEST_CASE("sizes keep their shape") {
  CHECK(fitting_size({1000, 500, 1, {}}, 256) == ImageSize{256, 128});
  CHECK(fitting_size({3000, 2, 1, {}}, 64) == ImageSize{64, 1});
  CHECK(fitting_size({100, 50, 1, {}}, 256) == ImageSize{100, 50});
  CHECK(fitting_size({100, 50, 1, {}}, 0) == ImageSize{100, 50});
  const auto one = resized({5, 1, 3, {9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9}}, {1, 1}, PixelMeaning::color);
  CHECK(one.pixels == std::vector<std::uint8_t>{9, 9, 9});
}

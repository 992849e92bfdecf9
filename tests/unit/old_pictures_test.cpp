#include <catch2/catch.hpp>

#include "base/image/image.h"

using namespace wrlkit;
using namespace std::string_literals;

namespace {

using Pixels = std::vector<std::uint8_t>;

std::string big_endian(std::uint32_t v, int bytes) {
  std::string s;
  for (int i = bytes - 1; i >= 0; --i) s += static_cast<char>(v >> (8 * i));
  return s;
}

/// The head of a picture of 2 x 2 pixels.
std::string sgi_head(bool packed, int depth, int channels) {
  auto s = "\x01\xda"s + static_cast<char>(packed) + static_cast<char>(depth);
  for (int v : {channels > 1 ? 3 : 2, 2, 2, channels}) s += big_endian(static_cast<std::uint32_t>(v), 2);
  s.resize(512);
  return s;
}

Image decoded_old(const std::string& bytes) {
  std::string error;
  const auto image = decode_image(bytes, {}, error);
  INFO(error);
  REQUIRE(image);
  return *image;
}

std::string fault_of_old(const std::string& bytes) {
  std::string error;
  CHECK_FALSE(decode_image(bytes, {}, error));
  return error;
}

}  // namespace

TEST_CASE("SGI: rows from below, one channel after the other", "[image]") {
  const auto bytes = sgi_head(false, 1, 3) + "\x01\x02\x03\x04\x11\x12\x13\x14\x21\x22\x23\x24";
  CHECK(sniff_mime(bytes) == "image/x-sgi");
  const auto image = decoded_old(bytes);
  CHECK(image.channels == 3);
  CHECK(image.pixels == Pixels{3, 0x13, 0x23, 4, 0x14, 0x24, 1, 0x11, 0x21, 2, 0x12, 0x22});
  CHECK(decoded_old(sgi_head(false, 2, 1) + "\x01\xff\x02\xff\x03\xff\x04\xff"s).pixels == Pixels{3, 4, 1, 2});
  CHECK(fault_of_old(bytes.substr(0, bytes.size() - 1)) == "its data are damaged");
}

TEST_CASE("SGI: run lengths", "[image]") {
  const auto table = big_endian(528, 4) + big_endian(531, 4) + big_endian(3, 4) + big_endian(4, 4);
  const auto bytes = sgi_head(true, 1, 1) + table + "\x02\x63\0"s + "\x82\x07\x08\0"s;
  CHECK(decoded_old(bytes).pixels == Pixels{7, 8, 0x63, 0x63});
  CHECK(fault_of_old(bytes.substr(0, 532)) == "its data are damaged");
  CHECK(fault_of_old(sgi_head(true, 1, 1) + big_endian(1 << 30, 4) + table) == "its data are damaged");
}

namespace {

/// 4 x 4 texels in one block of eight bytes a layer.
std::string dds_head(std::uint32_t layers) {
  auto bytes = "DDS |"s;
  bytes.resize(128);
  const auto put = [&](std::size_t at, std::uint32_t v) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(v >> (8 * i));
  };
  put(8, layers > 1 ? 0x801007 : 0x1007);  // caps, height, width, pixel format; depth
  put(12, 4);                              // height
  put(16, 4);                              // width
  put(24, layers);
  put(76, 32);  // size of the pixel format
  put(80, 4);   // FourCC
  bytes.replace(84, 4, "DXT1");
  put(108, layers > 1 ? 0x1008 : 0x1000);  // texture; of several surfaces
  put(112, layers > 1 ? 0x200000 : 0);     // a volume
  return bytes;
}

}  // namespace

TEST_CASE("DDS: BC1", "[image]") {
  // Two colours of 5, 6 and 5 bits, red and blue, and two bits a pixel: the upper two rows red, the others blue.
  const auto block = "\x00\xf8\x1f\x00\x00\x00\x55\x55"s;
  const auto image = decoded_old(dds_head(1) + block);
  REQUIRE(image.width == 4);
  REQUIRE(image.channels >= 3);
  const auto row = static_cast<std::size_t>(4 * image.channels);
  CHECK(Pixels(image.pixels.begin(), image.pixels.begin() + 3) == Pixels{255, 0, 0});
  CHECK(image.pixels[row * 2] == 0);
  CHECK(image.pixels[row * 2 + 2] == 255);
  CHECK_FALSE(fault_of_old(dds_head(1).substr(0, 100)).empty());
  CHECK(fault_of_old(dds_head(1) + block.substr(1)) == "its data are damaged");
  CHECK(fault_of_old(dds_head(3) + block + block + block) == "it is not a DDS of BC1 to BC5 in one layer");
}

TEST_CASE("DDS: BC4 and BC5, by their letters and by DXGI_FORMAT", "[image]") {
  // A channel from 10 to 250: the first row has the lower end, the others the upper one.
  const auto ramp = "\xfa\x0a\x49\x02\x00\x00\x00\x00"s;
  auto bc4 = dds_head(1);
  bc4.replace(84, 4, "BC4U");
  CHECK(decoded_old(bc4 + ramp).pixels.at(0) == 10);
  const auto grey = decoded_old(bc4 + ramp);
  CHECK(Pixels(grey.pixels.begin() + 16, grey.pixels.begin() + 20) == Pixels{250, 250, 250, 255});
  auto bc5 = dds_head(1);
  bc5.replace(84, 4, "DX10");
  bc5 += "\x53\0\0\0\x03\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0"s;
  const auto two = decoded_old(bc5 + "\x80\x80\0\0\0\0\0\0"s + ramp);
  CHECK(Pixels(two.pixels.begin(), two.pixels.begin() + 4) == Pixels{128, 10, 0, 255});
  auto cube = bc5;
  cube[136] = 4;  // miscFlag
  CHECK(fault_of_old(cube + ramp + ramp) == "it is not a DDS of BC1 to BC5 in one layer");
  bc5[128] = 0x54;  // SNORM
  CHECK(fault_of_old(bc5 + ramp + ramp) == "it is not a DDS of BC1 to BC5 in one layer");
}

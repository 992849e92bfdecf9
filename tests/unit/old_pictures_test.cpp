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
  CHECK(fault_of_old(dds_head(3) + block + block + block) == "it is not a DDS of BC1 to BC5 or BC7 in one layer");
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
  CHECK(fault_of_old(cube + ramp + ramp) == "it is not a DDS of BC1 to BC5 or BC7 in one layer");
  bc5[128] = 0x54;  // SNORM
  CHECK(fault_of_old(bc5 + ramp + ramp) == "it is not a DDS of BC1 to BC5 or BC7 in one layer");
}

namespace {

/// Bits from the lowest of the first byte on.
struct BlockOfBits {
  std::string bytes = std::string(16, '\0');
  unsigned at = 0;
  BlockOfBits& put(unsigned v, unsigned n) {
    for (unsigned i = 0; i < n; ++i, ++at)
      if (v >> i & 1u) bytes[at / 8] = static_cast<char>(bytes[at / 8] | 1 << at % 8);
    return *this;
  }
};

std::string bc7_head() {
  auto bytes = dds_head(1);
  bytes.replace(84, 4, "DX10");
  return bytes + "\x62\0\0\0\x03\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0"s;
}

Pixels texel(const Image& image, std::size_t i) {
  return {image.pixels.begin() + static_cast<std::ptrdiff_t>(4 * i),
          image.pixels.begin() + static_cast<std::ptrdiff_t>(4 * i + 4)};
}

}  // namespace

TEST_CASE("DDS: BC7, by hand", "[image]") {
  // Mode 6: from (0, 2, 4, 254) + 1 to (254, 2, 4, 254); texel 1 has the second colour, texel 2 something between.
  BlockOfBits six;
  six.put(64, 7).put(0, 7).put(127, 7).put(1, 7).put(1, 7).put(2, 7).put(2, 7).put(127, 7).put(127, 7).put(1, 1).put(0,
                                                                                                                     1);
  six.put(0, 3).put(15, 4).put(8, 4);
  const auto image = decoded_old(bc7_head() + six.bytes);
  CHECK(texel(image, 0) == Pixels{1, 3, 5, 255});
  CHECK(texel(image, 1) == Pixels{254, 2, 4, 254});
  CHECK(texel(image, 2) == Pixels{static_cast<std::uint8_t>((30 * 1 + 34 * 254 + 32) >> 6), 2, 4, 254});
  // Mode 3, partition 13 (the lower half): red above, blue below; every texel has the first colour of its pair.
  BlockOfBits three;
  three.put(8, 4).put(13, 6);
  for (unsigned red : {127, 127, 0, 0}) three.put(red, 7);
  for (unsigned i = 0; i < 4; ++i) three.put(0, 7);
  for (unsigned blue : {0, 0, 127, 127}) three.put(blue, 7);
  three.put(0, 4);
  const auto two = decoded_old(bc7_head() + three.bytes);
  CHECK(texel(two, 0) == Pixels{254, 0, 0, 255});
  CHECK(texel(two, 7) == Pixels{254, 0, 0, 255});
  CHECK(texel(two, 8) == Pixels{0, 0, 254, 255});
  CHECK(texel(decoded_old(bc7_head() + std::string(16, '\0')), 5) == Pixels{0, 0, 0, 0});
  CHECK(fault_of_old(bc7_head() + six.bytes.substr(1)) == "its data are damaged");
}

namespace {

std::string pcx_of(std::uint8_t bits, std::uint8_t planes, std::uint8_t row, const std::string& data) {
  auto head = "\x0a\x05\x01"s + static_cast<char>(bits);
  head.resize(128);
  head[8] = 2;   // 3 pixels wide
  head[10] = 1;  // 2 high
  head[65] = static_cast<char>(planes);
  head[66] = static_cast<char>(row);
  return head + data;
}

}  // namespace

TEST_CASE("PCX", "[image]") {
  // Runs may go on from plane to plane.
  const auto colored = pcx_of(8, 3, 4, "\xc4\x09\xc8\x07\x01\x02\x03\0\xc8\xff"s);
  CHECK(sniff_mime(colored) == "image/x-pcx");
  CHECK(decoded_old(colored).pixels == Pixels{9, 7, 7, 9, 7, 7, 9, 7, 7, 1, 255, 255, 2, 255, 255, 3, 255, 255});
  std::string palette(768, '\0');
  palette[3 * 5] = 50;
  palette[3 * 6 + 1] = 60;
  const auto indexed = pcx_of(8, 1, 4, "\x05\x06\x05\0\x06\x06\x05\0\x0c"s) + palette;
  CHECK(decoded_old(indexed).pixels == Pixels{50, 0, 0, 0, 60, 0, 50, 0, 0, 0, 60, 0, 0, 60, 0, 50, 0, 0});
  CHECK(decoded_old(pcx_of(1, 1, 2, "\xc1\xa0\0\x40\0"s)).pixels ==
        Pixels{255, 255, 255, 0, 0, 0, 255, 255, 255, 0, 0, 0, 255, 255, 255, 0, 0, 0});
  auto ega = pcx_of(1, 4, 2, "\xc1\x80\0\0\0\0\0\xc1\x80\0\xc8\0"s);  // indices 9, 0, 0; 0, 0, 0
  ega[16 + 3 * 9 + 2] = 77;
  CHECK(decoded_old(ega).pixels.at(2) == 77);
  CHECK(fault_of_old(colored.substr(0, colored.size() - 2)) == "its data are damaged");
  CHECK(fault_of_old(pcx_of(8, 3, 1, "\xff\0"s)) == "its data are damaged");  // rows that are too short
  CHECK(fault_of_old(pcx_of(4, 3, 2, "\xff\0"s)) == "its data are damaged");  // 12 bits
  CHECK(fault_of_old(pcx_of(4, 2, 2, "\xff\0"s)) == "its data are damaged");  // 8 bits, and 16 colours
  auto huge = colored;
  huge.replace(8, 4, "\xff\xff\xff\xff");
  huge.replace(66, 2, "\xff\xff");
  CHECK_FALSE(fault_of_old(huge).empty());
  for (std::size_t n = 0; n < colored.size(); ++n) fault_of_old(colored.substr(0, n));
}

TEST_CASE("PCX: a size that the data cannot have is refused before memory is taken", "[image]") {
  auto bomb = pcx_of(8, 4, 0, std::string(27'000, '\xff'));
  bomb.replace(8, 4, "\xff\x3f\xff\x3f");
  bomb.replace(66, 2, "\0\x40"s);
  CHECK(fault_of_old(bomb) == "its 27128 bytes cannot hold 16384 x 16384 pixels");
  auto dense = pcx_of(8, 1, 63, "\xff\x07\xff\x07"s);  // two rows, as short as they get
  dense[8] = 62;
  CHECK(decoded_old(dense).pixels == Pixels(3 * 2 * 63, 7));
}

TEST_CASE("PCX: without a palette, the 16 colours of an EGA", "[image]") {
  auto ega = pcx_of(1, 4, 2, "\xc1\x80\0\0\0\0\0\xc1\x80\0\0\0\x40\0\x40\0\0\0"s);  // indices 9, 0, 0; 0, 6, 0
  ega.replace(16, 48, std::string(48, '\x33'));
  CHECK(decoded_old(ega).pixels.at(0) == 0x33);
  for (char version : {'\0', '\3'}) {
    ega[1] = version;
    CHECK(decoded_old(ega).pixels == Pixels{0x55, 0x55, 0xff, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xaa, 0x55, 0, 0, 0, 0});
  }
  auto two = pcx_of(1, 1, 2, "\xc1\xa0\0\x40\0"s);
  two[1] = 3;
  two[16] = 0x33;
  CHECK(decoded_old(two).pixels.at(0) == 255);
}

TEST_CASE("PCX: four colours of a CGA are refused by name", "[image]") {
  CHECK(fault_of_old(pcx_of(2, 1, 2, "\x1b\0\x1b\0"s)) == "it is a PCX of the four colours of a CGA");
  CHECK(decoded_old(pcx_of(1, 2, 2, "\x40\0\0\0\0\0\0\0"s)).width == 3);
}

TEST_CASE("X bitmaps", "[image]") {
  const auto text =
      "/* an arrow */\n#define a_width 3\n#define a_height 2\nstatic unsigned char a_bits[] = { 0x05, 2 };\n"s;
  CHECK(sniff_mime(text) == "image/x-xbitmap");
  const auto image = decoded_old(text);
  CHECK(image.channels == 1);
  CHECK(image.pixels == Pixels{0, 255, 0, 255, 0, 255});
  CHECK(
      decoded_old("#define a_width 17\n#define a_height 1\nstatic short a_bits[] = {0x8000,\n0x0001};").pixels.at(16) ==
      0);
  CHECK(fault_of_old(text.substr(0, text.find("2 }"))) == "its data are damaged");
  CHECK(fault_of_old("#define a_width 3000\n#define a_height 3000\nstatic char a_bits[] = {0};")
            .ends_with("cannot hold 3000 x 3000 pixels"));
  CHECK(fault_of_old("#define a_width 9\n#define a_height 99999999999\nstatic char a_bits[] = {0};") ==
        "it is no picture of a known type");
  CHECK(sniff_mime("#define WIDTH 3\nint main() {}").empty());
}

TEST_CASE("X bitmaps: only the type of the bits says how long they are", "[image]") {
  const auto size = "#define shortcut_width 3\n#define shortcut_height 2\n"s;
  const Pixels arrow{0, 255, 0, 255, 0, 255};
  const auto wide =
      "#define shortcut_width 9\n#define shortcut_height 1\nstatic unsigned char shortcut_bits[] = {0, 1};"s;
  CHECK(decoded_old(wide).pixels.at(8) == 0);
  CHECK(decoded_old("/* short { 9, 9 } */\n" + size + "// a short {\nstatic char a_bits[] = { 5, 2 };\n").pixels ==
        arrow);
  CHECK(decoded_old(size + "static short other = 1;\nstatic char short-cut_bits[] = /* { 9 */ { 5, 2 };").pixels ==
        arrow);
  CHECK(decoded_old("#define a_width 17\n#define a_height 1 /* char {\n */\nstatic unsigned short\na_bits[]={0,1};")
            .pixels.at(16) == 0);
  CHECK(fault_of_old(size + "/* a_bits {5, 2} */ int a[] = {5, 2};") == "its data are damaged");
  CHECK(fault_of_old(size + "/* a_bits {5, 2}") == "its data are damaged");
}

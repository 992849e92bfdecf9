#include "base/image/image.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "base/image/image_codecs.h"
#include "tests/unit/folders.h"
#include "tests/unit/skip.h"

using namespace wrlkit;
using namespace std::string_literals;

namespace {

using Pixels = std::vector<std::uint8_t>;

std::string le(std::uint32_t v, int bytes) {
  std::string s;
  for (int i = 0; i < bytes; ++i) s += static_cast<char>(v >> (8 * i));
  return s;
}

std::string be32(std::uint32_t v) {
  auto s = le(v, 4);
  return {s.rbegin(), s.rend()};
}

std::uint32_t crc32(std::string_view s) {
  std::uint32_t c = ~0u;
  for (unsigned char b : s) {
    c ^= b;
    for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
  }
  return ~c;
}

std::uint32_t adler32(std::string_view s) {
  std::uint32_t a = 1, b = 0;
  for (unsigned char c : s) {
    a = (a + c) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

std::string chunk(const std::string& type, const std::string& data) {
  return be32(static_cast<std::uint32_t>(data.size())) + type + data + be32(crc32(type + data));
}

struct Png {
  std::uint32_t width, height;
  int depth, type;
  std::string rows;        // each with its filter byte
  std::string extra = {};  // chunks before IDAT
};

/// A PNG whose data are stored, not compressed.
std::string bytes_of(const Png& p) {
  auto n = static_cast<std::uint32_t>(p.rows.size());
  auto data = "\x78\x01\x01"s + le(n, 2) + le(~n, 2) + p.rows + be32(adler32(p.rows));
  auto header = be32(p.width) + be32(p.height) + static_cast<char>(p.depth) + static_cast<char>(p.type) + "\0\0\0"s;
  return "\x89PNG\r\n\x1a\n"s + chunk("IHDR", header) + p.extra + chunk("IDAT", data) + chunk("IEND", "");
}

/// A GIF picture of 2-bit colours. LZW codes begin with 3 bits; a clear code (4) every other pixel keeps them so.
std::string gif_picture(std::uint32_t x, std::uint32_t y, std::uint32_t w, std::uint32_t h, const Pixels& indices) {
  std::uint32_t bits = 0;
  int n = 0;
  std::string data;
  auto code = [&](std::uint32_t c) {
    bits |= c << n;
    for (n += 3; n >= 8; n -= 8, bits >>= 8) data += static_cast<char>(bits);
  };
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (i % 2 == 0) code(4);
    code(indices[i]);
  }
  code(5);
  if (n > 0) data += static_cast<char>(bits);
  return "\x2c" + le(x, 2) + le(y, 2) + le(w, 2) + le(h, 2) + "\0\2"s + static_cast<char>(data.size()) + data + "\0"s;
}

std::string gif(std::uint32_t w, std::uint32_t h, const std::string& blocks) {
  const auto palette = "\xff\0\0\0\xff\0\0\0\xff\x10\x20\x30"s;
  return "GIF89a" + le(w, 2) + le(h, 2) + "\x81\0\0"s + palette + blocks + "\x3b";
}

const std::string gif_transparent_2 = "\x21\xf9\x04\x01\0\0\x02\0"s;

std::string bmp(std::int32_t w, std::int32_t h, int bits, const std::string& data, const std::string& palette = {},
                const std::string& masks = {}) {
  auto header = static_cast<std::uint32_t>(40 + masks.size());
  auto start = static_cast<std::uint32_t>(14 + header + palette.size());
  return "BM" + le(static_cast<std::uint32_t>(start + data.size()), 4) + le(0, 4) + le(start, 4) + le(header, 4) +
         le(static_cast<std::uint32_t>(w), 4) + le(static_cast<std::uint32_t>(h), 4) + le(1, 2) +
         le(static_cast<std::uint32_t>(bits), 2) + le(masks.empty() ? 0 : 3, 4) +
         le(static_cast<std::uint32_t>(data.size()), 4) + le(2835, 4) + le(2835, 4) +
         le(static_cast<std::uint32_t>(palette.size() / 4), 4) + le(0, 4) + masks + palette + data;
}

std::string tga(int type, std::uint32_t w, std::uint32_t h, int bits, int descriptor, const std::string& data,
                const std::string& palette = {}) {
  auto colours = static_cast<std::uint32_t>(palette.size() / 3);
  return le(0, 1) + le(colours > 0, 1) + le(static_cast<std::uint32_t>(type), 1) + le(0, 2) + le(colours, 2) +
         le(colours ? 24 : 0, 1) + le(0, 4) + le(w, 2) + le(h, 2) + le(static_cast<std::uint32_t>(bits), 1) +
         le(static_cast<std::uint32_t>(descriptor), 1) + palette + data;
}

Image decoded(const std::string& bytes, const std::string& name = {}) {
  std::string error;
  auto image = decode_image(bytes, name, error);
  INFO(error);
  REQUIRE(image);
  auto header = read_image_header(bytes, name);
  REQUIRE(header);
  CHECK(header->width == image->width);
  CHECK(header->height == image->height);
  CHECK(header->channels == image->channels);
  CHECK(header->alpha == (image->channels % 2 == 0));
  return *image;
}

std::string fault(const std::string& bytes, const std::string& name = {}) {
  std::string error;
  CHECK_FALSE(decode_image(bytes, name, error));
  return error;
}

Image gradient(int w, int h, int channels) {
  Image image{w, h, channels, {}};
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int c = 0; c < channels; ++c)
        image.pixels.push_back(static_cast<std::uint8_t>((x * (3 + c) + y * 5 + c * 40) % 256));
  return image;
}

}  // namespace

TEST_CASE("The type of a picture is told by its first bytes", "[image]") {
  CHECK(sniff_mime("\x89PNG\r\n\x1a\n....") == "image/png");
  CHECK(sniff_mime("\xff\xd8\xff\xe0....") == "image/jpeg");
  CHECK(sniff_mime("GIF89a....") == "image/gif");
  CHECK(sniff_mime("BM....") == "image/bmp");
  CHECK(sniff_mime("II*\0...."s) == "image/tiff");
  CHECK(sniff_mime("MM\0*...."s) == "image/tiff");
  CHECK(sniff_mime("RIFF....WEBPVP8 ") == "image/webp");
  CHECK(sniff_mime("\x76\x2f\x31\x01....") == "image/x-exr");
  CHECK(sniff_mime("#?RADIANCE\n") == "image/vnd.radiance");
  CHECK(sniff_mime("#VRML V2.0 utf8", "a.png").empty());
  CHECK(sniff_mime("").empty());
}

TEST_CASE("A TGA without magic bytes is told by its name and a header that makes sense", "[image]") {
  auto bytes = tga(2, 1, 1, 24, 0, "abc");
  CHECK(sniff_mime(bytes, "A.TGA") == "image/x-tga");
  CHECK(sniff_mime(bytes, "a.wrl").empty());
  CHECK(sniff_mime(bytes).empty());
  CHECK(sniff_mime("no picture at all", "a.tga").empty());
  CHECK(sniff_mime(bytes + "\0\0\0\0\0\0\0\0TRUEVISION-XFILE.\0"s) == "image/x-tga");
}

TEST_CASE("PNG: colour types", "[image]") {
  SECTION("RGB, top row first") {
    auto image = decoded(bytes_of({2, 2, 8, 2, "\0\xff\0\0\0\xff\0"s + "\0\0\0\xff\1\2\3"s}));
    CHECK(image.channels == 3);
    CHECK(image.pixels == Pixels{255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3});
  }
  SECTION("RGBA: colours are not multiplied by alpha, and survive an alpha of 0") {
    auto image = decoded(bytes_of({2, 1, 8, 6, "\0\xc8\x64\x32\x80\x0a\x14\x1e\0"s}));
    CHECK(image.pixels == Pixels{200, 100, 50, 128, 10, 20, 30, 0});
  }
  SECTION("grey of 16 bits") {
    auto image = decoded(bytes_of({3, 1, 16, 0, "\0\0\0\x80\x80\xff\xff"s}));
    CHECK(image.channels == 1);
    CHECK(image.pixels == Pixels{0, 128, 255});
  }
  SECTION("grey of 1 bit") {
    CHECK(decoded(bytes_of({8, 1, 1, 0, "\0\xa1"s})).pixels == Pixels{255, 0, 255, 0, 0, 0, 0, 255});
  }
  SECTION("grey and alpha") {
    auto image = decoded(bytes_of({2, 1, 8, 4, "\0\x64\x80\x0a\0"s}));
    CHECK(image.channels == 2);
    CHECK(image.pixels == Pixels{100, 128, 10, 0});
  }
  SECTION("a palette of greys is RGB") {
    auto image = decoded(bytes_of({2, 1, 8, 3, "\0\1\0"s, chunk("PLTE", "\x10\x10\x10\x20\x20\x20")}));
    CHECK(image.channels == 3);
    CHECK(image.pixels == Pixels{32, 32, 32, 16, 16, 16});
  }
  SECTION("a palette with alpha") {
    auto image =
        decoded(bytes_of({2, 1, 8, 3, "\0\1\0"s, chunk("PLTE", "\x10\x11\x12\x20\x21\x22") + chunk("tRNS", "\x40")}));
    CHECK(image.channels == 4);
    CHECK(image.pixels == Pixels{32, 33, 34, 255, 16, 17, 18, 64});
  }
  SECTION("a transparent colour") {
    auto image = decoded(bytes_of({2, 1, 8, 2, "\0\1\2\3\4\5\6"s, chunk("tRNS", "\0\1\0\2\0\3"s)}));
    CHECK(image.pixels == Pixels{1, 2, 3, 0, 4, 5, 6, 255});
  }
  SECTION("a gamma changes nothing") {
    auto image = decoded(bytes_of({1, 1, 8, 2, "\0\x64\x65\x66"s, chunk("gAMA", be32(100000))}));
    CHECK(image.pixels == Pixels{100, 101, 102});
  }
}

TEST_CASE("GIF: the first picture on its canvas", "[image]") {
  SECTION("opaque") {
    auto image = decoded(gif(2, 2, gif_picture(0, 0, 2, 2, {0, 1, 2, 3})));
    CHECK(image.channels == 3);
    CHECK(image.pixels == Pixels{255, 0, 0, 0, 255, 0, 0, 0, 255, 16, 32, 48});
  }
  SECTION("a transparent colour") {
    auto image = decoded(gif(2, 1, gif_transparent_2 + gif_picture(0, 0, 2, 1, {2, 1})));
    REQUIRE(image.channels == 4);
    CHECK(image.pixels[3] == 0);
    CHECK(Pixels(image.pixels.begin() + 4, image.pixels.end()) == Pixels{0, 255, 0, 255});
  }
  SECTION("an animation") {
    auto image = decoded(gif(1, 1, gif_picture(0, 0, 1, 1, {1}) + gif_picture(0, 0, 1, 1, {2})));
    CHECK(image.pixels == Pixels{0, 255, 0});
  }
  SECTION("a picture that does not fill the canvas") {
    auto image = decoded(gif(2, 2, gif_picture(1, 1, 1, 1, {3})));
    REQUIRE(image.channels == 4);
    CHECK(image.pixels[3] == 0);
    CHECK(Pixels(image.pixels.end() - 4, image.pixels.end()) == Pixels{16, 32, 48, 255});
  }
}

TEST_CASE("BMP: rows from the bottom, padded to four bytes, blue first", "[image]") {
  SECTION("24 bits") {
    auto image = decoded(bmp(1, 2, 24, "\1\2\3\0\4\5\6\0"s));
    CHECK(image.pixels == Pixels{6, 5, 4, 3, 2, 1});
  }
  SECTION("a negative height is top row first") {
    CHECK(decoded(bmp(1, -2, 24, "\1\2\3\0\4\5\6\0"s)).pixels == Pixels{3, 2, 1, 6, 5, 4});
  }
  SECTION("a grey palette is RGB") {
    auto image = decoded(bmp(2, 1, 8, "\1\0\0\0"s, "\x10\x10\x10\0\x20\x20\x20\0"s));
    CHECK(image.channels == 3);
    CHECK(image.pixels == Pixels{32, 32, 32, 16, 16, 16});
  }
  SECTION("the fourth byte of 32 bits is padding") {
    auto image = decoded(bmp(2, 1, 32, "\1\2\3\0\4\5\6\x80"s));
    CHECK(image.channels == 3);
    CHECK(image.pixels == Pixels{3, 2, 1, 6, 5, 4});
  }
  SECTION("unless a mask says that it is alpha") {
    auto masks = le(0xff0000, 4) + le(0xff00, 4) + le(0xff, 4) + le(0xff000000, 4) + std::string(52, '\0');
    auto image = decoded(bmp(2, 1, 32, "\1\2\3\x40\4\5\6\x80"s, {}, masks));
    CHECK(image.pixels == Pixels{3, 2, 1, 64, 6, 5, 4, 128});
  }
}

TEST_CASE("TGA: origin, alpha, run lengths, palettes", "[image]") {
  constexpr int top_first = 0x20;
  SECTION("bottom row first") {
    CHECK(decoded(tga(2, 1, 2, 24, 0, "\1\2\3\4\5\6"), "a.tga").pixels == Pixels{6, 5, 4, 3, 2, 1});
  }
  SECTION("top row first") {
    CHECK(decoded(tga(2, 1, 2, 24, top_first, "\1\2\3\4\5\6"), "a.tga").pixels == Pixels{3, 2, 1, 6, 5, 4});
  }
  SECTION("alpha") {
    auto image = decoded(tga(2, 2, 1, 32, top_first | 8, "\1\2\3\x40\4\5\6\x80"), "a.tga");
    CHECK(image.pixels == Pixels{3, 2, 1, 64, 6, 5, 4, 128});
  }
  SECTION("an alpha of 0 everywhere is none") {
    auto image = decoded(tga(2, 2, 1, 32, top_first | 8, "\1\2\3\0\4\5\6\0"s), "a.tga");
    CHECK(image.pixels == Pixels{3, 2, 1, 255, 6, 5, 4, 255});
  }
  SECTION("32 bits of which none is alpha") {
    auto image = decoded(tga(2, 2, 1, 32, top_first, "\1\2\3\x40\4\5\6\x80"), "a.tga");
    CHECK(image.pixels == Pixels{3, 2, 1, 6, 5, 4});
  }
  SECTION("run lengths") {
    auto image = decoded(tga(10, 4, 1, 24, top_first, "\x82\1\2\3\0\4\5\6"s), "a.tga");
    CHECK(image.pixels == Pixels{3, 2, 1, 3, 2, 1, 3, 2, 1, 6, 5, 4});
  }
  SECTION("palette") {
    auto image = decoded(tga(1, 2, 1, 8, top_first, "\1\0"s, "\1\2\3\4\5\6"), "a.tga");
    CHECK(image.pixels == Pixels{6, 5, 4, 3, 2, 1});
  }
  SECTION("grey") {
    auto image = decoded(tga(3, 2, 1, 8, top_first, "\x10\x20"), "a.tga");
    CHECK(image.channels == 1);
    CHECK(image.pixels == Pixels{16, 32});
  }
}

TEST_CASE("JPEG: grey, colour, and the four inks of print", "[image]") {
  std::string error;
  auto grey = decoded(*encode_jpeg({8, 8, 1, Pixels(64, 77)}, 95, error));
  CHECK(grey.channels == 1);
  CHECK(std::abs(grey.pixels[10] - 77) <= 1);
  auto colour = decoded(*encode_jpeg(gradient(64, 48, 3), 95, error));
  double sum = 0;
  for (std::size_t i = 0; i < colour.pixels.size(); ++i)
    sum += std::abs(colour.pixels[i] - gradient(64, 48, 3).pixels[i]);
  CHECK(sum / static_cast<double>(colour.pixels.size()) < 8);
  // 8 x 8 pixels of four components; every coefficient is 0, so that each ink is 128: (128 / 255)^2 * 255 = 64.
  std::string quantiser(64, '\1'),
      tables = "\0"s + "\1"s + std::string(15, '\0') + "\0"s + "\x10\1"s + std::string(15, '\0') + "\0"s;
  auto cmyk = "\xff\xd8\xff\xee\0\x0e"s + "Adobe\0\x64\0\0\0\0\0"s + "\xff\xdb\0\x43\0"s + quantiser +
              "\xff\xc0\0\x14\x08\0\x08\0\x08\4\1\x11\0\2\x11\0\3\x11\0\4\x11\0"s + "\xff\xc4\0\x26"s + tables +
              "\xff\xda\0\x0e\4\1\0\2\0\3\0\4\0\0\x3f\0"s + "\0"s + "\xff\xd9"s;
  auto print = decoded(cmyk);
  CHECK(print.channels == 3);
  CHECK(std::abs(print.pixels[0] - 64) <= 1);
}

TEST_CASE("PNG is written with nothing but the pixels, the same bytes each time", "[image]") {
  for (int channels = 1; channels <= 4; ++channels) {
    auto image = gradient(37, 11, channels);
    std::string error;
    auto first = encode_png(image, error), second = encode_png(image, error);
    REQUIRE(first);
    CHECK(*first == *second);
    auto back = decoded(*first);
    CHECK(back.channels == channels);
    CHECK(back.pixels == image.pixels);
    CHECK(first->find("tIME") == std::string::npos);
    CHECK(first->find("tEXt") == std::string::npos);
    CHECK(first->substr(37 - 4, 4).size() == 4);
    CHECK(first->substr(8 + 25 + 4, 4) == "IDAT");
  }
}

TEST_CASE("JPEG is written without alpha, smaller with a lower quality", "[image]") {
  std::string error;
  auto image = gradient(64, 64, 4);
  auto good = encode_jpeg(image, 95, error), poor = encode_jpeg(image, 20, error);
  REQUIRE((good && poor));
  CHECK(poor->size() < good->size());
  CHECK(*good == *encode_jpeg(with_channels(image, 3), 95, error));
  CHECK(decoded(*good).channels == 3);
}

TEST_CASE("A picture that is no picture cannot be written", "[image]") {
  std::string error;
  CHECK_FALSE(encode_png({0, 0, 3, {}}, error));
  CHECK_FALSE(encode_png({2, 2, 3, Pixels(5)}, error));
  CHECK(error == "it has no pixels");
}

TEST_CASE("Sizes that cannot be are refused before any memory is asked for", "[image]") {
  auto claims = [](std::uint32_t w, std::uint32_t h) { return bytes_of({w, h, 8, 2, "\0abc"s}); };
  CHECK(fault(claims(100000, 100)) == "100000 x 100 pixels are too many");
  CHECK(fault(claims(60000, 60000)) == "60000 x 60000 pixels are too many");
  CHECK_THAT(fault(claims(16000, 16000)), Catch::Contains("cannot hold 16000 x 16000 pixels"));
  CHECK(image_size_fault(16384, 16384, 100 << 20).empty());
  CHECK(image_size_fault(2048, 2048, 10).empty());
  CHECK(image_size_fault(3000, 3000, SIZE_MAX).empty());
  CHECK(image_size_fault(0, 5, 10) == "it has no pixels");
}

TEST_CASE("What is no picture says so", "[image]") {
  CHECK(fault("#VRML V2.0 utf8\n") == "it is no picture of a known type");
  CHECK(fault("") == "it is no picture of a known type");
  CHECK_FALSE(fault("\x89PNG\r\n\x1a\n").empty());
  CHECK_FALSE(fault("GIF89a").empty());
}

TEST_CASE("Damaged pictures end with a picture or a reason, whatever is damaged", "[image]") {
  std::string error;
  const std::vector<std::pair<std::string, std::string>> whole{
      {*encode_png(gradient(9, 7, 4), error), ""},
      {*encode_jpeg(gradient(24, 17, 3), 80, error), ""},
      {gif(2, 2, gif_transparent_2 + gif_picture(0, 0, 2, 2, {0, 1, 2, 3})), ""},
      {bmp(2, 1, 8, "\1\0\0\0"s, "\x10\x10\x10\0\x20\x20\x20\0"s), ""},
      {tga(10, 4, 1, 24, 0, "\x82\1\2\3\0\4\5\6"s), "a.tga"},
  };
  std::mt19937 random(1);
  for (auto& [bytes, name] : whole) {
    auto survive = [&, &name = name](const std::string& b) {
      error.clear();
      auto image = decode_image(b, name, error);
      bool sound = image && image->pixels.size() == std::size_t(image->width) * image->height * image->channels;
      CHECK((sound || !error.empty()));
    };
    for (std::size_t n = 0; n < bytes.size(); n += 1 + bytes.size() / 200) survive(bytes.substr(0, n));
    for (int i = 0; i < 300; ++i) {
      auto b = bytes;
      for (int k = 0; k < 3; ++k) b[random() % b.size()] = static_cast<char>(random());
      survive(b);
    }
  }
}

TEST_CASE("Channels are dropped, spread and filled", "[image]") {
  Image rgba{1, 1, 4, {10, 20, 30, 40}}, grey{2, 1, 1, {5, 6}};
  CHECK(with_channels(rgba, 3).pixels == Pixels{10, 20, 30});
  CHECK(with_channels(rgba, 2).pixels == Pixels{10, 40});
  CHECK(with_channels(grey, 3).pixels == Pixels{5, 5, 5, 6, 6, 6});
  CHECK(with_channels(grey, 4).pixels == Pixels{5, 5, 5, 255, 6, 6, 6, 255});
}

TEST_CASE("Pictures are decoded by several threads at once", "[image]") {
  std::string error;
  auto image = gradient(200, 100, 3);
  auto png = *encode_png(image, error);
  std::array<bool, 4> same{};
  {
    std::vector<std::jthread> threads;
    for (auto& s : same)
      threads.emplace_back([&] {
        std::string why;
        auto back = decode_image(png, "", why);
        s = back && back->pixels == image.pixels;
      });
  }
  CHECK(std::ranges::all_of(same, [](bool s) { return s; }));
}

TEST_CASE("Every picture of the corpus is decoded, or says why not", "[image][found]") {
  namespace fs = std::filesystem;
  const auto folder = shared_folder("corpus");
  if (!fs::is_directory(folder)) {
    return skip("there is no folder " + folder.string() + " (WRLKIT_SHARED)");
  }
  constexpr std::string_view extensions[] = {".png", ".jpg", ".gif", ".dds"};
  int decoded = 0, refused = 0;
  for (auto& entry : fs::recursive_directory_iterator(folder)) {
    if (std::ranges::find(extensions, entry.path().extension().string()) == std::end(extensions)) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(in), {}), error;
    auto header = read_image_header(bytes, entry.path().string());
    auto image = decode_image(bytes, entry.path().string(), error);
    INFO(entry.path() << ": " << error);
    (image ? decoded : refused)++;
    CHECK(image.has_value() != !error.empty());
    if (image)
      CHECK((header && header->width == image->width && header->height == image->height &&
             header->channels == image->channels));
  }
  CHECK(decoded == 216);
  CHECK(refused == 1);  // a volume
}

TEST_CASE("image: the codecs are named by an absolute path, and before they are used", "[image]") {
  CHECK_FALSE(set_image_codecs("wrlkit_images.so"));
  CHECK_FALSE(set_image_codecs(""));
  std::string error;
  auto bytes = encode_jpeg({1, 1, 3, {1, 2, 3}}, 90, error);
  CHECK(bytes);
  CHECK_FALSE(set_image_codecs("/nowhere/wrlkit_images.so"));
}

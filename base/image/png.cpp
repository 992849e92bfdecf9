#include "base/image/png.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <vector>

namespace wrlkit {
namespace {

std::uint32_t crc(std::string_view s) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(s.data()), s.size()));
}

/// Bytes as zlib data (RFC 1950).
std::string zlib_packed(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::bad_alloc();
  out.resize(size);
  return out;
}

std::uint32_t big_endian(std::string_view s) {
  std::uint32_t v = 0;
  for (unsigned char b : s.substr(0, 4)) v = v << 8 | b;
  return v;
}

std::string four(std::uint32_t v) {
  return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

std::string chunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type) + std::string(data);
  return four(static_cast<std::uint32_t>(data.size())) + body + four(crc(body));
}

/// What the neighbours say a byte will be (ISO/IEC 15948, 9.2): a is left of it, b above, c above a.
template <int filter>
int foreseen(int a, int b, int c) {
  const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
  if constexpr (filter == 1) return a;
  if constexpr (filter == 2) return b;
  if constexpr (filter == 3) return (a + b) / 2;
  if constexpr (filter == 4) return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
  return 0;
}

/// The byte of the filter, and the row as differences from what was foreseen.
class Rows {
 public:
  Rows(std::size_t width, std::size_t step) : step_(step), above_(width), tried_(width + 1, 0), chosen_(width + 1, 0) {}

  void append(const std::uint8_t* row, std::string& to) {
    best_ = -1;
    attempt<0>(row);
    attempt<1>(row);
    attempt<2>(row);
    attempt<3>(row);
    attempt<4>(row);
    to += chosen_;
    std::copy_n(row, above_.size(), above_.begin());
  }

 private:
  template <int filter>
  void attempt(const std::uint8_t* row) {
    tried_[0] = filter;
    long sum = 0;
    for (std::size_t i = 0; i < above_.size(); ++i) {
      const int a = i < step_ ? 0 : row[i - step_], c = i < step_ ? 0 : above_[i - step_];
      const auto d = static_cast<std::int8_t>(row[i] - foreseen<filter>(a, above_[i], c));
      tried_[i + 1] = static_cast<char>(d);
      sum += std::abs(int{d});
    }
    if (best_ >= 0 && sum >= best_) return;
    best_ = sum;
    chosen_.swap(tried_);
  }

  std::size_t step_;
  std::vector<std::uint8_t> above_;
  std::string tried_, chosen_;
  long best_ = -1;  // sum of the chosen one
};

}  // namespace

std::optional<std::string> essential_png(std::string_view png) {
  constexpr std::string_view kept[] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  constexpr std::size_t signature = 8, frame = 12;  // length, type and sum around the data of a chunk
  std::string out(png.substr(0, signature));
  bool has_pixels = false;
  for (std::size_t at = signature; png.size() >= at + frame;) {
    std::size_t length = big_endian(png.substr(at));
    if (length > png.size() - at - frame) return std::nullopt;
    auto chunk = png.substr(at, length + frame), type = chunk.substr(4, 4);
    at += chunk.size();
    if (std::ranges::find(kept, type) == std::end(kept)) continue;
    if (crc(chunk.substr(4, length + 4)) != big_endian(chunk.substr(length + 8))) return std::nullopt;
    if ((out.size() == signature) != (type == "IHDR")) return std::nullopt;
    out += chunk;
    has_pixels |= type == "IDAT";
    if (type == "IEND") return has_pixels ? std::optional(out) : std::nullopt;
  }
  return std::nullopt;
}

std::string png_of(const Image& image) {
  constexpr char color_type[] = {0, 4, 2, 6};  // grey, grey and alpha, RGB, RGBA
  const auto channels = static_cast<std::size_t>(image.channels),
             width = channels * static_cast<std::size_t>(image.width);
  std::string rows;
  rows.reserve((width + 1) * static_cast<std::size_t>(image.height));
  Rows filter(width, channels);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
    filter.append(image.pixels.data() + y * width, rows);
  const std::string head = four(static_cast<std::uint32_t>(image.width)) +
                           four(static_cast<std::uint32_t>(image.height)) +
                           std::string{8, color_type[channels - 1], 0, 0, 0};
  std::string out = "\x89PNG\r\n\x1a\n" + chunk("IHDR", head);
  const std::string packed = zlib_packed(rows);
  constexpr std::size_t largest = std::size_t{1} << 30;  // of a chunk
  for (std::size_t at = 0; at < packed.size(); at += largest)
    out += chunk("IDAT", std::string_view(packed).substr(at, largest));
  return out + chunk("IEND", {});
}

}  // namespace wrlkit

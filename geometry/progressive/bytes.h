// Bytes of a compact file, little endian: fixed numbers, and whole numbers of seven bits a byte (varints), the lowest
// first, the top bit set in all bytes but the last. Signed ones are folded: 0, -1, 1, -2, ... are 0, 1, 2, 3, ...
#pragma once
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace wrlkit::simplify {

class ByteWriter {
 public:
  explicit ByteWriter(std::string& out) : out_(out) {}

  void byte(std::uint8_t b) { out_.push_back(static_cast<char>(b)); }
  void bytes(std::string_view s) { out_ += s; }
  void number(std::uint64_t n) {
    for (; n > 127; n >>= 7) byte(static_cast<std::uint8_t>(n | 128));
    byte(static_cast<std::uint8_t>(n));
  }
  void whole(std::int64_t n) { number(static_cast<std::uint64_t>(n) << 1 ^ static_cast<std::uint64_t>(n >> 63)); }
  void fixed(std::unsigned_integral auto n) {
    for (std::size_t i = 0; i < sizeof n; ++i) byte(static_cast<std::uint8_t>(n >> 8 * i));
  }
  void fixed(float f) { fixed(std::bit_cast<std::uint32_t>(f)); }
  void fixed(double f) { fixed(std::bit_cast<std::uint64_t>(f)); }

 private:
  std::string& out_;
};

/// Reads what a ByteWriter wrote. Behind the end of the bytes everything is 0, and `ended` is true from then on.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size(); }
  bool ended() const { return ended_; }

  std::uint8_t byte() {
    if (bytes_.empty()) {
      ended_ = true;
      return std::uint8_t{0};
    }
    const auto b = static_cast<std::uint8_t>(bytes_.front());
    bytes_.remove_prefix(1);
    return b;
  }
  std::string_view bytes(std::uint64_t n) {
    if (n > bytes_.size()) {
      ended_ = true;
      bytes_ = {};
      return std::string_view();
    }
    const auto s = bytes_.substr(0, static_cast<std::size_t>(n));
    bytes_.remove_prefix(s.size());
    return s;
  }
  std::uint64_t number() {
    std::uint64_t n = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const std::uint8_t b = byte();
      n |= std::uint64_t{b & 127u} << shift;
      if (b < 128) break;
    }
    return n;
  }
  std::int64_t whole() {
    const std::uint64_t n = number();
    return static_cast<std::int64_t>(n >> 1 ^ (0 - (n & 1)));
  }
  template <class T>
  T fixed() {
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) n |= std::uint64_t{byte()} << 8 * i;
    if constexpr (sizeof(T) == 4)
      return std::bit_cast<T>(static_cast<std::uint32_t>(n));
    else
      return std::bit_cast<T>(n);
  }

 private:
  std::string_view bytes_;
  bool ended_ = false;
};

}  // namespace wrlkit::simplify

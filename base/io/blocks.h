// Bytes that only grow, in blocks that never move: hundreds of megabytes are collected without being copied, and
// written from where they lie.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

namespace wrlkit {

class Blocks {
 public:
  void append(const void* data, std::size_t n) {
    auto* from = static_cast<const char*>(data);
    while (n > 0) {
      if (size_ == blocks_.size() * block) blocks_.emplace_back(new char[block]);
      std::size_t now = std::min<std::size_t>(n, block - size_ % block);
      std::memcpy(blocks_.back().get() + size_ % block, from, now);
      from += now;
      n -= now;
      size_ += now;
    }
  }
  void append(std::string_view s) { append(s.data(), s.size()); }

  std::uint64_t size() const { return size_; }

  /// Are the n bytes at an offset those at `data`? All of them must exist.
  bool equal(std::uint64_t at, const void* data, std::size_t n) const {
    auto* other = static_cast<const char*>(data);
    while (n > 0) {
      std::size_t now = std::min<std::size_t>(n, block - at % block);
      if (std::memcmp(blocks_[at / block].get() + at % block, other, now) != 0) return false;
      other += now;
      n -= now;
      at += now;
    }
    return true;
  }

  /// The n bytes at an offset, all of which must exist.
  void copy(std::uint64_t at, void* to, std::size_t n) const {
    auto* out = static_cast<char*>(to);
    while (n > 0) {
      std::size_t now = std::min<std::size_t>(n, block - at % block);
      std::memcpy(out, blocks_[at / block].get() + at % block, now);
      out += now;
      n -= now;
      at += now;
    }
  }

  /// All bytes, in order.
  void pieces(std::vector<std::string_view>& out) const {
    for (std::uint64_t at = 0; at < size_; at += block)
      out.emplace_back(blocks_[at / block].get(), std::min<std::uint64_t>(block, size_ - at));
  }

 private:
  static constexpr std::size_t block = std::size_t{1} << 20;
  std::vector<std::unique_ptr<char[]>> blocks_;
  std::uint64_t size_ = 0;
};

}  // namespace wrlkit

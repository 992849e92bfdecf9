// gzip data (RFC 1952) to bytes, piece by piece: the packed data are never in memory as a whole.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/io/buffer.h"

namespace wrlkit {

/// Fills the span as far as it can and returns the number of bytes; 0 at the end.
using ReadMore = std::function<std::size_t(std::span<char>)>;

struct GunzipLimits {
  std::uint64_t bytes = 0;       // unpacked
  double ratio = 0;              // unpacked to packed, ...
  std::uint64_t ratio_from = 0;  // ... when more than this was unpacked
};

struct Gunzip {
  enum State { whole, damaged, too_many_bytes, too_high_ratio, no_memory };
  State state = whole;
  std::string why;           // damaged: what is wrong
  std::uint64_t packed = 0;  // bytes read
};

inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

/// Unpacks all members of gzip data; `head` is what was read of them already. What could be unpacked is in `out`,
/// whatever the state. Zeros behind the last member, with which tapes and some servers pad files, are harmless.
Gunzip gunzip(std::string_view head, const ReadMore&, const GunzipLimits&, BufferBuilder& out);

}  // namespace wrlkit

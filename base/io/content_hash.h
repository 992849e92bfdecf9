// What is the same: 128 bits over the bytes of a file. The only door to xxHash.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace wrlkit {

struct ContentHash {
  std::uint64_t high = 0, low = 0;
  bool operator==(const ContentHash&) const = default;
  std::string hex() const;
};

ContentHash hash_of(std::string_view bytes);
/// The hash of a regular file, read in pieces; nothing when it cannot be read.
std::optional<ContentHash> hash_of_file(const std::string& path);
/// What hex() gave; all zero when it is none.
ContentHash hash_from(std::string_view hex);

}  // namespace wrlkit

#include "base/io/content_hash.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <charconv>
#include <memory>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace wrlkit {
namespace {

ContentHash of(XXH128_hash_t h) { return {h.high64, h.low64}; }

}  // namespace

std::string ContentHash::hex() const { return fmt::format("{:016x}{:016x}", high, low); }

ContentHash hash_of(std::string_view bytes) { return of(XXH3_128bits(bytes.data(), bytes.size())); }

std::optional<ContentHash> hash_of_file(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return std::nullopt;
  struct stat there {};
  std::optional<ContentHash> hash;
  if (fstat(fd, &there) == 0 && S_ISREG(there.st_mode)) {
    std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
    XXH3_128bits_reset(state.get());
    constexpr std::size_t size = 256 * 1024;
    const auto piece = std::make_unique_for_overwrite<char[]>(
        size);  // a worker that clears it would spend more on that than on most files
    ssize_t got = 0;
    while ((got = ::read(fd, piece.get(), size)) > 0)
      XXH3_128bits_update(state.get(), piece.get(), static_cast<std::size_t>(got));
    if (got == 0) hash = of(XXH3_128bits_digest(state.get()));
  }
  close(fd);
  return hash;
}

ContentHash hash_from(std::string_view hex) {
  ContentHash h;
  if (hex.size() != 32) return h;
  std::from_chars(hex.data(), hex.data() + 16, h.high, 16);
  std::from_chars(hex.data() + 16, hex.data() + 32, h.low, 16);
  return h;
}

}  // namespace wrlkit

// A whole file as one text: read once, unzipped when its first bytes are those of gzip (the name does not matter), and
// registered with the sources that messages point into. The text need not be kept for that: a message reads the file
// again.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostics.h"
#include "base/io/buffer.h"

namespace wrlkit {

struct ReadLimits {
  static constexpr std::uint64_t one_text = (4ull << 30) - (64 << 10);  // offsets into it are 32-bit
  std::uint64_t max_bytes = one_text;
  std::uint64_t max_unpacked = one_text;
  double max_ratio = 200;  // unpacked to packed, once more than ratio_from is unpacked
  std::uint64_t ratio_from = 64 << 20;
  std::uint64_t max_device = 64 << 20;  // devices may never end
  /// From that size on a file that is not gzipped is mapped, which takes no memory for parts that were released. When
  /// another program shortens it meanwhile, this process gets SIGBUS: for programs that expect it.
  std::uint64_t map_from = none_is_mapped;
  static constexpr std::uint64_t none_is_mapped = UINT64_MAX, large = 16 << 20;  // below, memory does not matter
};

struct FileText {
  std::string name;  // for messages
  Buffer text;
  std::uint32_t base = 0;  // offset of the text in Diagnostics::sources()
  bool gzip = false;
  std::uint64_t bytes_on_disk = 0;

  std::string_view view() const { return text.view(); }
};

/// The path that means standard input, and what messages call it.
inline constexpr std::string_view standard_input = "-", standard_input_name = "<stdin>";

/// Reads a file. One message when nothing of it can be read. Of damaged or suspiciously large gzip data, what could be
/// unpacked is used, which is reported. Peak memory: the text, and a quarter more while gzip data or a pipe is read.
std::optional<FileText> read_file(const std::string& path, const ReadLimits&, Diagnostics&);

/// The bytes of a regular file as they are, of no more than `limit`; otherwise why not.
std::optional<std::string> read_bytes(const std::string& path, std::uint64_t limit, std::string& why);

/// "4 GiB", "64 MiB", "1500 bytes": sizes in messages.
std::string readable_size(std::uint64_t bytes);

}  // namespace wrlkit

#include "base/io/same_contents.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

namespace wrlkit {
namespace {

bool is_next(std::ifstream& file, std::string_view piece) {
  std::array<char, 64 * 1024> read{};
  while (!piece.empty()) {
    const auto n = std::min(piece.size(), read.size());
    if (!file.read(read.data(), static_cast<std::streamsize>(n))) return false;
    if (std::string_view(read.data(), n) != piece.substr(0, n)) return false;
    piece.remove_prefix(n);
  }
  return true;
}

}  // namespace

bool has_contents(const std::string& path, std::span<const std::string_view> pieces) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault)) return false;
  std::uintmax_t size = 0;
  for (const auto piece : pieces) size += piece.size();
  if (std::filesystem::file_size(path, fault) != size) return false;
  std::ifstream file(path, std::ios::binary);
  return file && std::ranges::all_of(pieces, [&](std::string_view piece) { return is_next(file, piece); });
}

}  // namespace wrlkit

#include "base/io/files_read.h"

#include <sys/stat.h>

#include <optional>

namespace wrlkit {
namespace {

std::optional<std::pair<std::uint64_t, std::uint64_t>> identity(const std::string& path) {
  struct stat there {};
  if (stat(path.c_str(), &there) != 0 || !S_ISREG(there.st_mode)) return {};
  return std::pair<std::uint64_t, std::uint64_t>(there.st_dev, there.st_ino);
}

}  // namespace

void FilesRead::add(const std::string& path) {
  const auto file = identity(path);
  const std::lock_guard lock(mutex_);
  if (file) files_.insert(*file);
}

bool FilesRead::has(const std::string& path) const {
  const auto file = identity(path);
  const std::lock_guard lock(mutex_);
  return file && files_.contains(*file);
}

}  // namespace wrlkit

// The files that something was read from. No output may take the place of one of them.
#pragma once
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace wrlkit {

/// Files are the same when they have one device and inode, whatever their paths. From several threads.
class FilesRead {
 public:
  /// A path without a regular file is left out.
  void add(const std::string& path);
  bool has(const std::string& path) const;

 private:
  mutable std::mutex mutex_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> files_;
};

}  // namespace wrlkit

// The files that were written for one output: itself, and what it refers to next to it.
#pragma once
#include <mutex>
#include <set>
#include <string>

namespace wrlkit {

/// From several threads.
class FilesWritten {
 public:
  /// Why no file is replaced that was there before and is none of these; empty: any is. Set before anything is written.
  std::string refusal;
  /// A symbolic link is replaced, and not what it leads to. Set before anything is written.
  bool replaces_links = false;

  bool has(const std::string& path) const {
    const std::lock_guard lock(mutex_);
    return paths_.contains(path);
  }
  void add(const std::string& path) {
    const std::lock_guard lock(mutex_);
    paths_.insert(path);
  }
  /// As they were named. Once nothing more is written.
  const std::set<std::string>& paths() const { return paths_; }

 private:
  mutable std::mutex mutex_;
  std::set<std::string> paths_;
};

}  // namespace wrlkit

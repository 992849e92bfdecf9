// The files that were written for one output: itself, and what it refers to next to it.
#pragma once
#include <functional>
#include <mutex>
#include <set>
#include <string>

namespace wrlkit {

/// From several threads.
class FilesWritten {
 public:
  /// Whether a file that is there may be replaced. None: any may be. Set before anything is written.
  std::function<bool(const std::string& path)> may_replace;

  void add(const std::string& path) {
    const std::lock_guard lock(mutex_);
    paths_.insert(path);
  }
  /// As they were named. Once nothing more is written.
  const std::set<std::string>& paths() const { return paths_; }

 private:
  std::mutex mutex_;
  std::set<std::string> paths_;
};

}  // namespace wrlkit

// How much of many files has been read, and how long it will take.
#pragma once
#include <span>
#include <vector>

#include "base/task.h"
#include "convert/tiles.h"

namespace wrlkit::tiles {

/// Counts megabytes of files. Of several files what is said of each by itself is not heard in the meantime: `monitor`
/// is null as long as this lives.
class ReadingProgress {
 public:
  ReadingProgress(std::span<const TilesInput> inputs, Monitor*& monitor);
  ~ReadingProgress();
  ReadingProgress(const ReadingProgress&) = delete;
  ReadingProgress& operator=(const ReadingProgress&) = delete;

  /// The next file has been read.
  void next();

 private:
  Monitor*& monitor_;
  Monitor* heard_ = nullptr;
  std::vector<std::uint64_t> end_;  // bytes to the end of each file
  std::size_t n_read_ = 0;
  std::uint64_t said_ = 0;  // megabytes
};

}  // namespace wrlkit::tiles

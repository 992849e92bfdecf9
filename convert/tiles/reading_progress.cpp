#include "convert/tiles/reading_progress.h"

#include <filesystem>
#include <utility>

namespace wrlkit::tiles {
namespace {

constexpr std::uint64_t megabyte = 1'000'000;

}  // namespace

ReadingProgress::ReadingProgress(std::span<const TilesInput> inputs, Monitor*& monitor) : monitor_(monitor) {
  if (!monitor || inputs.size() < 2) return;
  std::uint64_t all = 0;
  for (const auto& input : inputs) {
    std::error_code fault;
    const auto bytes = std::filesystem::file_size(input.path, fault);
    end_.push_back(all += fault ? 0 : bytes);
  }
  heard_ = std::exchange(monitor_, nullptr);
  heard_->begin("reading " + std::to_string(inputs.size()) + " files", all / megabyte + 1, "MB");
}

ReadingProgress::~ReadingProgress() {
  if (heard_) monitor_ = heard_;
}

void ReadingProgress::next() {
  if (!heard_ || n_read_ >= end_.size()) return;
  const auto read = end_[n_read_++] / megabyte;
  heard_->step(read - std::exchange(said_, read));
}

}  // namespace wrlkit::tiles

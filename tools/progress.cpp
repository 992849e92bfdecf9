#include "tools/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace wrlkit {

Progress::Progress(bool on) : on_(on), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::begin(std::string what, std::uint64_t total, std::string unit) {
  what_ = std::move(what);
  unit_ = std::move(unit);
  total_ = total;
  done_ = 0;
  start_ = last_ = Clock::now();
}

void Progress::show() {
  auto now = Clock::now();
  double since = std::chrono::duration<double>(now - last_).count(), elapsed = std::chrono::duration<double>(now - start_).count();
  if (elapsed < 1 || since < (terminal_ ? 0.2 : 10.0)) return;
  last_ = now;
  double rate = static_cast<double>(done_) / elapsed;
  std::string line = fmt::format("{}: {} {}", what_, done_, unit_);
  if (total_) line = fmt::format("{}: {}/{} {} ({} %)", what_, done_, total_, unit_, done_ * 100 / total_);
  line += fmt::format(", {:.0f}/s", rate);
  if (total_ && rate > 0) line += fmt::format(", {:.0f} s left", static_cast<double>(total_ - done_) / rate);
  std::fputs(terminal_ ? ("\r\033[K" + line).c_str() : (line + "\n").c_str(), stderr);
  std::fflush(stderr);
  shown_ = true;
}

void Progress::clear() {
  if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

}  // namespace wrlkit

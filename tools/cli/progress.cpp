#include "tools/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <system_error>

namespace wrlkit {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds soon = 1s, blink = 200ms, log_entry = 10s;
constexpr const char* clear_line = "\r\033[K";

constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t ending = 0;

void note_end(int which) { ending = which; }

/// The thread that draws ends the process by the signal, once the line is gone: what comes next on the terminal is the
/// shell's.
void watch_for_end() {
  for (const int s : ending_signals)
    if (const auto before = std::signal(s, note_end); before != SIG_DFL) std::signal(s, before);
}

void end_by(int which) {
  std::signal(which, SIG_DFL);
  std::raise(which);
}

std::string duration(double seconds) {
  const auto s = static_cast<std::uint64_t>(seconds + 0.5);
  if (s < 100) return fmt::format("{} s", s);
  return s < 6000 ? fmt::format("{} min", (s + 30) / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

Progress::Progress(bool on) : on_(on), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  clear();
  {
    std::lock_guard lock(mutex_);
    ended_ = true;
  }
  end_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (!watches_signals_) return;
  if (ending) end_by(ending);
  for (const int s : ending_signals)
    if (const auto before = std::signal(s, SIG_DFL); before != note_end) std::signal(s, before);
}

void Progress::begin(std::string what, std::uint64_t total, std::string unit) {
  if (!on_) return;
  std::lock_guard lock(mutex_);
  what_ = std::move(what);
  unit_ = std::move(unit);
  total_ = total;
  done_ = 0;
  start_ = Clock::now();
  if (quiet_) first_ = last_ = start_;
  quiet_ = false;
  if (thread_.joinable()) return;
  try {
    thread_ = std::thread(&Progress::watch, this);
  } catch (const std::system_error&) {  // no room for another thread: work goes on without being seen
    return;
  }
  watches_signals_ = terminal_;
  if (terminal_) watch_for_end();
}

void Progress::watch() {
  std::unique_lock lock(mutex_);
  while (!end_.wait_for(lock, blink, [&] { return ended_; })) {
    if (ending) {
      if (shown_) {
        std::fputs(clear_line, stderr);
        std::fflush(stderr);
      }
      end_by(ending);
    }
    const auto now = Clock::now();
    if (!quiet_ && now - first_ >= soon && now - last_ >= (terminal_ ? blink : log_entry)) show(now);
  }
}

void Progress::show(Clock::time_point now) {
  last_ = now;
  const std::string text = line(std::chrono::duration<double>(now - start_).count());
  std::fputs(terminal_ ? (clear_line + text).c_str() : (text + "\n").c_str(), stderr);
  std::fflush(stderr);
  shown_ = true;
}

std::string Progress::line(double seconds) const {
  const auto done = std::min(done_.load(std::memory_order_relaxed), total_ ? total_ : UINT64_MAX);
  if (!total_) return fmt::format("{}, {}", what_, duration(seconds));
  std::string text = fmt::format("{}: {}/{} {} ({} %)", what_, done, total_, unit_, done * 100 / total_);
  if (!done || seconds < 1) return text;
  const double rate = static_cast<double>(done) / seconds;
  return text + fmt::format(", {:.{}f}/s, {} left", rate, rate < 10 ? 1 : 0,
                            duration(static_cast<double>(total_ - done) / rate));
}

void Progress::clear() {
  std::lock_guard lock(mutex_);
  if (terminal_ && shown_) {
    std::fputs(clear_line, stderr);
    std::fflush(stderr);
  }
  shown_ = false;
  quiet_ = true;
}

}  // namespace wrlkit

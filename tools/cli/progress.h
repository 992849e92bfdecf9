// How far long work is: a line that is overwritten on a terminal, a line every ten seconds in a log, nothing for work
// that takes less than a second. A thread of its own draws it, so that work shows which never says how far it is.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "passes/pipeline/pass.h"

namespace wrlkit {

class Progress : public Monitor {
 public:
  explicit Progress(bool on);
  ~Progress() override;

  void begin(std::string what, std::uint64_t total, std::string unit) override;
  void step(std::uint64_t n = 1) override { done_.fetch_add(n, std::memory_order_relaxed); }
  /// How many of them are done.
  void set(std::uint64_t done) { done_.store(done, std::memory_order_relaxed); }
  /// Takes the line off the terminal. Nothing is drawn before the next begin().
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void watch();
  void show(Clock::time_point now);
  std::string line(double seconds) const;

  const bool on_, terminal_;
  std::mutex mutex_;  // of all that follows but done_
  std::condition_variable end_;
  bool ended_ = false, quiet_ = true, shown_ = false, watches_signals_ = false;
  std::string what_, unit_;
  std::uint64_t total_ = 0;
  Clock::time_point first_, start_, last_;  // of the work, of this stretch of it; when it was shown
  std::atomic<std::uint64_t> done_ = 0;
  std::thread thread_;
};

}  // namespace wrlkit

// How far long work is: a line that is overwritten on a terminal, a line every ten seconds in a log, nothing for work
// that takes less than a second.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

#include "passes/pass.h"

namespace wrlkit {

class Progress : public Monitor {
 public:
  explicit Progress(bool on);
  ~Progress() override { clear(); }

  void begin(std::string what, std::uint64_t total, std::string unit) override;
  void step(std::uint64_t n = 1) override {
    if (on_ && ((done_ += n) & 0xff) < n) show();
  }
  /// So many of them are done.
  void set(std::uint64_t done) {
    done_ = done;
    if (on_) show();
  }
  /// Takes the line off the terminal.
  void clear();

 private:
  void show();
  using Clock = std::chrono::steady_clock;
  bool on_, terminal_ = false, shown_ = false;
  std::string what_, unit_;
  std::uint64_t done_ = 0, total_ = 0;
  Clock::time_point start_, last_;
};

}  // namespace wrlkit

#include "tools/cli/time_limit.h"

#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <string>

#include "tools/cli/end_now.h"

namespace wrlkit {
namespace {

std::string message;  // a handler may not make one

void give_up(int) { end_now(message); }

}  // namespace

void limit_time(double seconds) {
  // The line of progress goes first.
  message = fmt::format("{}wrlkit: error: it takes longer than {:g} s (--timeout)\n",
                        isatty(STDERR_FILENO) ? "\r\033[K" : "", seconds);
  std::signal(SIGALRM, give_up);
  const double whole = std::floor(seconds);
  const itimerval once{{0, 0}, {static_cast<time_t>(whole), static_cast<suseconds_t>((seconds - whole) * 1e6)}};
  setitimer(ITIMER_REAL, &once, nullptr);
}

}  // namespace wrlkit

#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <atomic>

#include "base/background.h"
#include "base/stop.h"

namespace wrlkit {
namespace {

std::atomic<int> limits_of_one = 0;

}  // namespace

bool only_one_thread() { return limits_of_one > 0; }

void parallel_for(std::size_t n, const std::function<void(std::size_t)>& f) {
  if (only_one_thread()) {
    for (std::size_t i = 0; i < n; ++i) {
      check_stop();
      f(i);
    }
    return;
  }
  const auto* stop = StopScope::current();
  if (!stop) return tbb::parallel_for(std::size_t{0}, n, f);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    const StopScope scope(*stop);
    check_stop();
    f(i);
  });
}

struct ThreadLimit::Control {
  tbb::global_control limit;
};

// One thread does not need oneTBB, which looks through 80 places for a library when it is first used: in a process that
// converts one small file that is a good part of its time.
ThreadLimit::ThreadLimit(int threads) : one_(threads == 1) {
  if (one_)
    ++limits_of_one;
  else if (threads > 0)
    // NOLINTNEXTLINE(modernize-make-unique): makes no aggregates
    control_.reset(new Control{{tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}});
}
ThreadLimit::~ThreadLimit() {
  if (one_) --limits_of_one;
}

struct Background::Group {
  tbb::task_group tasks;
};

Background::Background() : group_(std::make_unique<Group>()) {}

Background::~Background() {
  try {
    group_->tasks.wait();
  } catch (...) {
  }
}

void Background::run(std::function<void()> work) { group_->tasks.run(std::move(work)); }
void Background::wait() { group_->tasks.wait(); }

}  // namespace wrlkit

// Work on all cores. The only door to oneTBB: what runs in parallel writes to places of its own, so that results do not
// depend on the number of threads.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>

namespace wrlkit {

/// Calls f(0) to f(n - 1), in no order, on as many threads as there may be. Calls within f are allowed. An exception of
/// f is thrown here, and Stopped between two calls (stop.h).
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& f);

/// As long as one of these lives, parallel_for uses at most that many threads; 0: as many as there are cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

 private:
  struct Control;
  std::unique_ptr<Control> control_;
  bool one_;
};

/// Whether a ThreadLimit of one lives: for libraries that have threads of their own.
bool only_one_thread();

}  // namespace wrlkit

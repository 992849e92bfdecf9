#include "passes/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace wrlkit {

void parallel_for(std::size_t n, const std::function<void(std::size_t)>& f) { tbb::parallel_for(std::size_t{0}, n, f); }

struct ThreadLimit::Control {
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0) control_.reset(new Control{{tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)}});
}
ThreadLimit::~ThreadLimit() = default;

}  // namespace wrlkit

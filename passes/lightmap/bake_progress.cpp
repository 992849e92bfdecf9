#include "passes/lightmap/bake_progress.h"

#include <algorithm>
#include <utility>

namespace wrlkit::bake {

std::uint64_t BakeProgress::share(std::size_t view) const {
  constexpr std::size_t most_halvings = 15;
  return std::max<std::uint64_t>(1, first_total_ >> (2 * std::min(view, most_halvings)));
}

void BakeProgress::begin(std::string what, std::uint64_t total, std::string unit) {
  if (!counts_ || (!first_total_ && !total)) return to_->begin(std::move(what), total, std::move(unit));
  total_ = total;
  done_ = passed_ = 0;
  if (first_total_ || !total) return;
  first_total_ = total;
  std::uint64_t all = 0;
  for (std::size_t view = view_; view < std::max(n_views_, view_ + 1); ++view) all += share(view - view_);
  to_->begin(std::move(what), all, std::move(unit));
}

void BakeProgress::step(std::uint64_t n) {
  if (!counts_) return to_->step(n);
  if (!total_) return;
  done_ = std::min(total_, done_ + n);
  const auto part = static_cast<double>(done_) / static_cast<double>(total_);
  const auto now = static_cast<std::uint64_t>(part * static_cast<double>(share(view_)));
  if (now > passed_) to_->step(now - std::exchange(passed_, now));
}

}  // namespace wrlkit::bake

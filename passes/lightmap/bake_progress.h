// How far a bake is, all views of it as one stretch of work.
#pragma once
#include <cstddef>
#include <cstdint>

#include "base/task.h"

namespace wrlkit::bake {

/// Passes on what is said, until the first view begins to count: its tiles and those to be expected of the other views
/// become one stretch, which what they say themselves only moves. Each view has half the texels a metre of the one
/// before, so it takes a fourth of the time.
class BakeProgress final : public Monitor {
 public:
  /// `to` may be null. `counts` false: how much work there is will not be known, and all is passed on.
  BakeProgress(Monitor* to, std::size_t n_views, bool counts) : to_(to), n_views_(n_views), counts_(counts) {}

  /// Null where nobody watches.
  Monitor* monitor() { return to_ ? this : nullptr; }
  void begin_view(std::size_t view) { view_ = view; }
  void begin(std::string what, std::uint64_t total, std::string unit) override;
  void step(std::uint64_t n = 1) override;

 private:
  std::uint64_t share(std::size_t view) const;

  Monitor* to_;
  std::size_t n_views_, view_ = 0;
  bool counts_;
  std::uint64_t first_total_ = 0;                    // of the first view; 0: it has not begun to count
  std::uint64_t total_ = 0, done_ = 0, passed_ = 0;  // of this view; how much of its share was passed on
};

}  // namespace wrlkit::bake

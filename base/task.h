// What a long task gets in addition to its input: where it reports, what it counts, who watches it, who may stop
// it.
#pragma once
#include <cstdint>
#include <map>
#include <stop_token>
#include <string>

#include "base/diagnostics.h"

namespace wrlkit {

/// Counts of what was done: "tessellate.triangles" and so on. Sums, so that their order does not matter.
using Statistics = std::map<std::string, std::uint64_t, std::less<>>;

/// Learns how far work is that takes long.
class Monitor {
 public:
  virtual ~Monitor() = default;
  /// A new stretch of work: a total of `total` in that unit ("shapes"); 0: how many is not known.
  virtual void begin(std::string what, std::uint64_t total, std::string unit) = 0;
  /// N more are done. One thread at a time.
  virtual void step(std::uint64_t n = 1) = 0;
};

struct Task {
  Diagnostics& diag;
  Statistics& stats;
  Monitor* monitor = nullptr;  // null: not watched
  std::stop_token stop{};
};

}  // namespace wrlkit

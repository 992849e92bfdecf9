// What is compared of two worlds, and how they differ: for the verb and for reports of many.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/deviation.h"
#include "tools/cli/session.h"
#include "tools/shown_surface.h"

namespace wrlkit {

/// What is compared of a world.
struct WorldFacts {
  std::map<std::string, std::uint64_t, std::less<>> nodes;  // authored, each once
  std::set<std::string, std::less<>> names;                 // when prototypes and Inlines are expanded
  std::uint64_t materials = 0;                              // the same
  GeometryCensus geometry;
  std::optional<ShownSurface> surface;
};

struct WorldDifference {
  WorldFacts a, b;
  std::vector<std::string_view> missing, added;  // names
  double bounds = 0;                             // the largest difference of a number; infinite: one world has none
  std::optional<Deviation> surface;              // none: too large to be measured
  double of_diagonal = 0;
};

/// Reads a world with a session; nothing when there is none to be had.
std::optional<WorldFacts> facts_of(Session&, const std::string& path);
WorldDifference difference(WorldFacts a, WorldFacts b);

}  // namespace wrlkit

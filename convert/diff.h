// How two scenes differ in what they show and do, and in their names and nodes.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "convert/behaviour_census.h"
#include "convert/document.h"
#include "convert/look_census.h"
#include "convert/shown_surface.h"
#include "geometry/deviation.h"

namespace wrlkit {

/// What is compared of a scene.
struct WorldFacts {
  std::map<std::string, std::uint64_t, std::less<>> nodes;  // authored, each once
  std::set<std::string, std::less<>> names;                 // when prototypes and Inlines are expanded
  std::uint64_t materials = 0;                              // the same
  GeometryCensus geometry;
  std::map<SurfaceLook, double> looks;  // and their areas
  BehaviourCensus behaviour;
  std::optional<ShownSurface> surface;
};

struct WorldDifference {
  WorldFacts a, b;
  std::vector<std::string_view> missing, added;  // names; not those that were only repaired
  double bounds = 0;                             // the largest difference of a number; infinite: one scene has none
  std::optional<Deviation> surface;              // none: too large to be measured
  double of_diagonal = 0;
  LookDifference looks;
  SaidDifference routes, animations, viewpoints, lights, others;
};

/// Nothing when the scene cannot be expanded, which is reported. The document is expanded; what is measured stays when
/// it is gone. `with_looks`: pictures are decoded.
std::optional<WorldFacts> facts_of(Document&&, bool with_looks = true);
/// The difference of two that were measured. O(n log n) in their triangles.
WorldDifference difference(WorldFacts a, WorldFacts b);

/// Nothing when one of the documents cannot be expanded; its messages say why.
std::optional<WorldDifference> diff(const Document& a, const Document& b);

}  // namespace wrlkit

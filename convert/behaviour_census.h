// What moves, looks and shines in a scene, and what else it says that is no form: by the values of its nodes.
#pragma once
#include <map>
#include <string>
#include <string_view>

#include "scenegraph/scene.h"

namespace wrlkit {

/// How often each of them is there, by its type and its values, to four digits: of Viewpoints and lights in the world.
/// Names do not count, for conversions may have to change them.
using SaidTimes = std::map<std::string, std::size_t>;

struct BehaviourCensus {
  SaidTimes routes;
  SaidTimes animations;  // interpolators, and what has a time of its own
  SaidTimes viewpoints, lights;
  SaidTimes others;  // Background, Fog, NavigationInfo, WorldInfo, sensors, Scripts, sounds, Anchors, ranges of LODs
};

/// Of a scene whose prototypes and Inlines are expanded. O(nodes and their values).
BehaviourCensus count_behaviour(const Scene& scene);

/// How many of two are in one and not in the other.
struct SaidDifference {
  std::size_t gone = 0, made = 0;
  explicit operator bool() const { return gone + made > 0; }
};
SaidDifference difference(const SaidTimes& a, const SaidTimes& b);

}  // namespace wrlkit

#include "scenegraph/places/named_places.h"

#include <unordered_map>
#include <utility>

#include "scenegraph/places/name_path.h"
#include "scenegraph/places/ways.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

struct Handed {  // down to children
  Matrix frame;
  std::uint32_t path = 0;
};

}  // namespace

NamedPlaces::NamedPlaces(const Scene& scene) {
  std::vector<char> is_named(scene.node_count());  // geometry whose name has been used
  Ways<Handed> ways(scene);
  ways.push(scene.main.roots, {});
  while (const auto step = ways.next()) {
    auto path = below(step->state.path, scene.name(step->node));
    if (!scene.is(step->node, nodes::Shape)) {
      ways.push(shown_children(scene, step->node), {step->state.frame * local_matrix(scene, step->node), path});
      continue;
    }
    const NodeId geometry = scene.get(step->node, nodes::shape::geometry);
    if (!geometry) continue;
    // The name of a geometry tells parts apart that have no other; where they have, it is kept with the first.
    const bool is_first = !std::exchange(is_named[geometry.value], 1);
    if (is_first || scene.name(step->node).empty()) path = below(path, scene.name(geometry));
    places_.push_back({step->node, step->state.frame, path});
  }
  too_many_ = ways.too_many();
  make_names();
}

std::uint32_t NamedPlaces::below(std::uint32_t path, std::string_view name) {
  if (name.empty()) return path;
  steps_.push_back({name, path});
  return static_cast<std::uint32_t>(steps_.size() - 1);
}

/// A step stands behind the one above it.
void NamedPlaces::make_names() {
  std::unordered_map<std::string, std::size_t> times;
  names_.resize(steps_.size());
  for (std::uint32_t i = 1; i < steps_.size(); ++i) {
    const auto& above = names_[steps_[i].above];
    names_[i] = path_below(above, steps_[i].name);
    if (const auto n = ++times[names_[i]]; n > 1) names_[i] += '#' + std::to_string(n);
  }
}

}  // namespace wrlkit

#include "scenegraph/x3d_version.h"

#include <algorithm>

#include "scenegraph/equal.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// The version that a node and its fields came with.
int since(const Scene& scene, NodeId n) {
  const auto& t = scene.type(n);
  int version = t.since;
  for (const Value& v : scene.fields(n))
    if (!scene.is_extra(v) && t.fields[v.slot].since > version && (v.is || !equals_default(v, t.fields[v.slot])))
      version = t.fields[v.slot].since;
  return version;
}

int since(const Scene& scene, NodeId n, std::string_view event) {
  const auto slot = scene.type(n).find(event, Dialect::x3d, true);
  return slot ? scene.type(n).fields[*slot].since : 0;
}

}  // namespace

int x3d_version(const Scene& scene) {
  int version = 33;
  if (scene.dialect() == Dialect::x3d) version = std::max(version, scene.x3d.version);
  for (NodeId n : all_nodes(scene)) version = std::max(version, since(scene, n));
  for_each_route(scene, [&](const Route& r) {
    version = std::max({version, since(scene, r.from, r.event_out), since(scene, r.to, r.event_in)});
  });
  return std::min(version, 40);
}

}  // namespace wrlkit

// The scopes of a scene: its main one, and the bodies of its prototypes.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// Calls f(scope) for the main scope, then for the body of each prototype, in the order of their declaration.
template <class SceneOrConst, class F>
void for_each_scope(SceneOrConst& scene, F&& f) {
  f(scene.main);
  for (std::uint32_t i = 0; i < scene.proto_count(); ++i) f(scene.proto(ProtoId{i}).body);
}

/// Calls f(route) for every ROUTE of every scope.
template <class F>
void for_each_route(const Scene& scene, F&& f) {
  for_each_scope(scene, [&](const Scope& s) {
    for (const Route& r : s.routes) f(r);
  });
}

}  // namespace wrlkit

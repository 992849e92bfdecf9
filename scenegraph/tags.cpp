#include "scenegraph/tags.h"

#include <algorithm>

#include "scenegraph/features.h"

namespace wrlkit {

bool is_tag(const Scene& scene, NodeId n, const Value& v) {
  if (scene.content(v).is) return false;
  if (scene.is_extra(v)) return true;
  if (v.type != FieldType::SFNode || !v.node || scene.type(n).kind == NodeKind::proto) return false;
  return scene.type(n).fields[v.slot].name == "metadata" && !features_of(scene, n);
}

bool has_tags(const Scene& scene, NodeId n) {
  return n && std::ranges::any_of(scene.fields(n), [&](const Value& v) { return is_tag(scene, n, v); });
}

}  // namespace wrlkit

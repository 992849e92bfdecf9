#include "scenegraph/container_field.h"

#include "scenegraph/browser_nodes.h"

namespace wrlkit {

std::string_view container_field(const Scene& scene, NodeId n) {
  constexpr int most_prototypes = 100;  // one of which is an instance of the next
  const NodeType* t = &scene.type(n);
  for (int i = 0; t->kind == NodeKind::proto && i < most_prototypes; ++i) {
    const auto& p = scene.proto(t->proto);
    if (p.external || p.body.roots.empty()) return "children";
    t = &scene.type(p.body.roots[0]);
  }
  if (const auto* known = t->kind == NodeKind::unknown ? find_browser_node(t->name) : nullptr)
    if (known->what == "geometry") return "geometry";
  return t->container_field.empty() ? std::string_view("children") : t->container_field;
}

}  // namespace wrlkit

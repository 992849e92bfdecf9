#include "scenegraph/dangling_links.h"

#include <algorithm>

#include "scenegraph/walk.h"

namespace wrlkit {

DanglingLinks drop_dangling_links(Scene& scene) {
  DanglingLinks out;
  Scope& main = scene.main;
  if (main.imports.empty() && main.exports.empty() && main.routes.empty()) return out;
  std::vector<char> here(scene.node_count());
  for (NodeId n : all_nodes(scene)) here[n.value] = 1;
  for (const Import& i : main.imports) here[i.node.value] = here[i.inline_node.value];
  const auto dangles = [&](const Route& r) { return !here[r.from.value] || !here[r.to.value]; };
  std::ranges::copy_if(main.routes, std::back_inserter(out.routes), dangles);
  std::erase_if(main.routes, dangles);
  out.any = !out.routes.empty();
  out.any |= std::erase_if(main.imports, [&](const Import& i) { return !here[i.node.value]; }) > 0;
  out.any |= std::erase_if(main.exports, [&](const Export& e) { return !here[e.node.value]; }) > 0;
  return out;
}

}  // namespace wrlkit

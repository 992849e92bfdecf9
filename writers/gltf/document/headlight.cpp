#include "writers/gltf/document/headlight.h"

#include <algorithm>

namespace wrlkit::gltf {

void add_headlight(Document& d, const Scene& scene) {
  if (d.lights.empty() || !visibility(scene, d.navigation_info).headlight) return;
  const auto id = d.add({.attached = static_cast<std::uint32_t>(d.lights.size()), .attachment = Attachment::light});
  d.lights.push_back({});
  if (d.cameras.empty()) return d.roots.push_back(id);
  auto is_first = [](const Node& n) { return n.attachment == Attachment::camera && n.attached == 0; };
  d.set_only_child(*std::ranges::find_if(d.nodes, is_first), id);
}

}  // namespace wrlkit::gltf

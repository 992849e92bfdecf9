#include "writers/gltf/document/dequantize.h"

namespace wrlkit::gltf {

void dequantize(Document& d, const std::function<const Dequantization*(std::uint32_t)>& of_mesh,
                const std::function<bool(const Node&)>& keeps) {
  for (std::size_t id = 0, n = d.nodes.size(); id < n; ++id) {
    const Node node = d.nodes[id];
    const auto* q = node.attachment == Attachment::mesh ? of_mesh(node.attached) : nullptr;
    if (!q) continue;
    if (keeps(node)) {
      const auto child = d.add({.transform = d.add_transform({q->origin, {}, {q->step, q->step, q->step}}),
                                .attached = node.attached,
                                .attachment = Attachment::mesh});
      d.nodes[id].attachment = Attachment::nothing;
      d.set_only_child(d.nodes[id], child);
      continue;
    }
    Trs t = d.place(node);
    t.translation = matrix(t).point(q->origin);
    for (double& s : t.scale) s *= q->step;
    d.nodes[id].transform = d.add_transform(t, true);
  }
}

}  // namespace wrlkit::gltf

#include "parsers/gltf/visibility.h"

#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {

bool is_hidden(Json node) {
  const Json visible = node["extensions"]["KHR_node_visibility"]["visible"];
  return visible && !visible.boolean(true);
}

void hide(const Context& context, Json at, std::size_t from, std::vector<NodeId>& list) {
  if (from >= list.size()) return;
  const auto first = list.begin() + static_cast<std::ptrdiff_t>(from);
  const NodeId choice = context.add(nodes::Switch, at);
  context.scene.set(choice, nodes::switch_::children, std::vector<NodeId>(first, list.end()));
  list.erase(first, list.end());
  list.push_back(choice);
}

}  // namespace wrlkit::gltf_reader

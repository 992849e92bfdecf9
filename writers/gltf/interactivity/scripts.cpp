#include "writers/gltf/interactivity/scripts.h"

#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

using Type = Graph::Type;

std::optional<Type> carried(FieldType type) {
  switch (type) {
    case FieldType::SFBool:
      return Type::boolean;
    case FieldType::SFInt32:
      return Type::integer;
    case FieldType::SFFloat:
    case FieldType::SFTime:
      return Type::number;
    case FieldType::SFVec3f:
    case FieldType::SFColor:
      return Type::vec3;
    case FieldType::SFRotation:
      return Type::vec4;  // as a quaternion
    default:
      return std::nullopt;
  }
}

}  // namespace

bool is_script(const Scene& scene, NodeId n) { return n && scene.type(n).name == "Script"; }

std::size_t n_common_script_fields() { return builtin_nodes()[nodes::Script.value].fields.size(); }

bool is_script_event(const Scene& scene, NodeId n, std::uint16_t slot) {
  return is_script(scene, n) && slot >= n_common_script_fields() &&
         carried(scene.type(n).fields[slot].type).has_value();
}

Scripts::Scripts(const Scene& scene, const Document& document, Graph& graph) : scene_(scene), graph_(graph) {
  for (std::uint32_t id = 0; id < document.nodes.size(); ++id)
    if (const NodeId n = document.nodes[id].source; n && is_script(scene, n)) nodes_.try_emplace(n.value, id);
}

std::optional<std::uint32_t> Scripts::event(std::string_view way, NodeId n, std::string_view name, FieldType type) {
  const auto at = nodes_.find(n.value);
  const auto value = carried(type);
  if (at == nodes_.end() || !value) return std::nullopt;
  const auto id = std::string(way) + ":" + std::to_string(at->second) + ":" + std::string(name);
  if (!first_) {
    first_ = n;
    first_event_ = id;
  }
  return graph_.custom_event(id, value);
}

void Scripts::tell(Graph::Flow at, NodeId n, std::uint16_t slot, const Graph::Value& value) {
  if (!at) return;
  const auto& field = scene_.type(n).fields[slot];
  if (const auto e = event("to-script", n, field.name, field.type)) graph_.send(at, *e, value);
}

Scripts::Told Scripts::told(NodeId n, std::uint16_t slot) {
  const auto& field = scene_.type(n).fields[slot];
  return told(n, field.name, field.type);
}

Scripts::Told Scripts::told(NodeId n, std::string_view name, FieldType type) {
  const auto e = event("from-script", n, name, type);
  if (!e) return {};
  auto flow = graph_.receive(*e);
  const auto node = flow.node;
  return {std::move(flow), {*carried(type), {}, node}};
}

void Scripts::report(Diagnostics& diag) const {
  if (!first_) return;
  diag.report(Diag::no_gltf_value, scene_.where(first_), "Script",
              "url, other than as events to the viewer such as '" + first_event_ + "',");
}

}  // namespace wrlkit::gltf

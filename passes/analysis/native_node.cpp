#include "passes/analysis/native_node.h"

#include <algorithm>

namespace wrlkit {
namespace {

/// "GeoCoordinate" of "urn:web3d:vrml97:node:GeoCoordinate"; empty when it is another kind of url.
std::string_view node_of_urn(std::string_view url) {
  if (!url.starts_with("urn:") && !url.starts_with("URN:")) return {};
  return url.substr(url.find_last_of(":#") + 1);
}

TypeId type_of(std::string_view node) {
  const TypeId own = find_builtin(node, Dialect::vrml97);
  return own ? own : find_builtin(node, Dialect::x3d);
}

}  // namespace

ProtoId native_proto(Scene& scene, const Proto& external) {
  TypeId type;
  for (auto url : external.urls)
    if (const auto node = node_of_urn(url); !type && !node.empty()) type = type_of(node);
  if (!type) return {};
  const NodeId body = scene.add(type, external.where);
  const auto own = scene.type(type).fields;
  const auto declared = scene.type(external.type).fields;
  std::vector<FieldDef> fields(declared.begin(), declared.end());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    FieldDef& f = fields[i];
    const auto slot = scene.type(type).find(f.name, scene.dialect());
    if (!slot || own[*slot].type != f.type) continue;
    if (own[*slot].has_value()) f.default_value = own[*slot].default_value;
    f.default_value.slot = static_cast<std::uint16_t>(i);
    Value is = scene.make(FieldType::verbatim, *slot, f.name);
    is.type = f.type;
    is.is = true;
    scene.set(body, is);
  }
  NodeType interface = scene.type(external.type);
  Proto proto;
  proto.type = scene.add_type(interface, fields);
  proto.where = external.where;
  proto.body.roots = {body};
  const TypeId made = proto.type;
  const ProtoId id = scene.add_proto(std::move(proto));
  scene.set_type_proto(made, id);
  return id;
}

}  // namespace wrlkit

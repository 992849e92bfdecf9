#include "scenegraph/features.h"

#include <algorithm>
#include <numeric>

#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

constexpr std::string_view parts = "parts", names = "names", faces = "faces";

std::optional<std::uint16_t> metadata_slot(const Scene& scene, NodeId n) {
  return scene.type(n).find("metadata", Dialect::x3d);
}

}  // namespace

std::size_t Features::n_faces() const { return std::accumulate(faces.begin(), faces.end(), std::size_t{0}); }

std::optional<Features> features_of(const Scene& scene, NodeId geometry) {
  const auto is_set = [&](const Value& v) {
    return v.type == FieldType::SFNode && !v.is && !scene.is_extra(v) && scene.is(v.node, nodes::MetadataSet);
  };
  if (std::ranges::none_of(scene.fields(geometry), is_set)) return std::nullopt;
  const auto slot = metadata_slot(scene, geometry);
  const Value* v = slot ? scene.find(geometry, *slot) : nullptr;
  if (!v || v->is || v->type != FieldType::SFNode || !scene.is(v->node, nodes::MetadataSet) ||
      scene.get(v->node, nodes::metadata_set::name) != parts)
    return std::nullopt;
  Features f;
  for (NodeId n : scene.get(v->node, nodes::metadata_set::value)) {
    if (scene.is(n, nodes::MetadataString) && scene.get(n, nodes::metadata_string::name) == names)
      f.names = scene.get(n, nodes::metadata_string::value);
    if (scene.is(n, nodes::MetadataInteger) && scene.get(n, nodes::metadata_integer::name) == faces)
      f.faces = scene.get(n, nodes::metadata_integer::value);
  }
  if (f.names.empty() || f.names.size() != f.faces.size() || std::ranges::any_of(f.faces, [](auto n) { return n < 0; }))
    return std::nullopt;
  return f;
}

void set_features(Scene& scene, NodeId geometry, const Features& f) {
  const auto slot = metadata_slot(scene, geometry);
  if (!slot) return;
  const NodeId texts = scene.add(nodes::MetadataString), numbers = scene.add(nodes::MetadataInteger),
               set = scene.add(nodes::MetadataSet);
  scene.set(texts, nodes::metadata_string::name, names);
  scene.set(texts, scene.make(FieldType::MFString, nodes::metadata_string::value.slot, f.names));
  scene.set(numbers, nodes::metadata_integer::name, faces);
  scene.set(numbers, scene.make(FieldType::MFInt32, nodes::metadata_integer::value.slot, f.faces));
  scene.set(set, nodes::metadata_set::name, parts, nodes::metadata_set::value, std::vector<NodeId>{texts, numbers});
  scene.set(geometry, scene.make(FieldType::SFNode, *slot, set));
}

}  // namespace wrlkit

#include "scenegraph/metadata.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"

namespace wrlkit {
namespace {

bool is_double(FieldType t) {
  constexpr FieldType types[] = {FieldType::SFDouble, FieldType::MFDouble, FieldType::SFTime,  FieldType::MFTime,
                                 FieldType::SFVec2d,  FieldType::MFVec2d,  FieldType::SFVec3d, FieldType::MFVec3d,
                                 FieldType::SFVec4d,  FieldType::MFVec4d};
  return std::ranges::find(types, t) != std::end(types);
}

/// A single string without its quotes; other text as the file has it.
std::string_view unquoted(std::string_view s) {
  const bool string = s.size() > 2 && s.front() == '"' && s.find_first_of("\"\\", 1) == s.size() - 1;
  return string ? s.substr(1, s.size() - 2) : s;
}

}  // namespace

NodeId metadata_of(Scene& scene, const MetadataName& as, const Value& v) {
  const auto make = [&](TypeId type, auto name_key, auto value_key, const auto& values) {
    const NodeId n = scene.add(type, as.where);
    scene.set(n, name_key, as.name, value_key, values);
    return n;
  };
  switch (info(v.type).element) {
    case Element::text: {
      const bool many = v.type == FieldType::MFString;
      const auto text = many ? std::string_view() : v.text();
      const std::string_view one[] = {v.type == FieldType::verbatim ? unquoted(text) : text};
      const std::span<const std::string_view> all = many ? v.text_span() : one;
      return make(nodes::MetadataString, nodes::metadata_string::name, nodes::metadata_string::value, all);
    }
    case Element::integer:
      if (v.type == FieldType::SFBool || v.type == FieldType::MFBool)
        return make(nodes::MetadataBoolean, nodes::metadata_boolean::name, nodes::metadata_boolean::value,
                    v.integer_span());
      [[fallthrough]];
    case Element::image:
      return make(nodes::MetadataInteger, nodes::metadata_integer::name, nodes::metadata_integer::value,
                  v.integer_span());
    case Element::number:
      if (is_double(v.type))
        return make(nodes::MetadataDouble, nodes::metadata_double::name, nodes::metadata_double::value,
                    v.number_span());
      return make(nodes::MetadataFloat, nodes::metadata_float::name, nodes::metadata_float::value, v.number_span());
    case Element::node:
      break;
  }
  return {};
}

NodeId metadata_set(Scene& scene, const MetadataName& as, std::span<const NodeId> members) {
  const NodeId set = scene.add(nodes::MetadataSet, as.where);
  scene.set(set, nodes::metadata_set::name, as.name, nodes::metadata_set::value, members);
  return set;
}

void add_metadata(Scene& scene, NodeId n, NodeId set) {
  const auto slot = scene.type(n).find("metadata", Dialect::x3d);
  const Value* old = slot ? scene.find(n, *slot) : nullptr;
  if (old && !old->is && old->type == FieldType::SFNode && old->node) {
    const NodeId before = old->node;
    const auto members = scene.get(set, nodes::metadata_set::value);
    std::vector<NodeId> all(members.begin(), members.end());
    all.push_back(before);
    const NodeId both = scene.add(nodes::MetadataSet, scene.where(set));
    scene.set_fields(both, scene.copy_of_fields(set));
    scene.set(both, nodes::metadata_set::value, all);
    set = both;
  }
  const Value value = scene.make(FieldType::SFNode, slot.value_or(Value::extra_slot), set);
  scene.set(n, slot ? value : scene.make_extra("metadata", value));
}

std::vector<Value> tags_for(const Scene& scene, NodeId n, TypeId type) {
  std::vector<Value> out;
  const auto slot = scene.type(type).find("metadata", Dialect::x3d);
  for (Value v : scene.fields(n)) {
    if (!is_tag(scene, n, v)) continue;
    if (!scene.is_extra(v)) {
      if (!slot) continue;
      v.slot = *slot;
    }
    out.push_back(v);
  }
  return out;
}

void take_tags(Scene& scene, NodeId from, NodeId to) {
  if (!from || !to || from == to || !has_tags(scene, from) || has_tags(scene, to)) return;
  for (const Value& v : tags_for(scene, from, scene.type_id(to))) scene.set(to, v);
}

}  // namespace wrlkit

#include "scenegraph/urls.h"

#include <algorithm>

namespace wrlkit {
namespace {

constexpr std::size_t deepest =
    16;  // prototypes inside each other: fields of deeper ones are known by their names only

UrlUse use_by_name(const NodeType& type, const FieldDef& field) {
  if (field.type != FieldType::MFString || (field.name != "url" && !field.name.ends_with("Url"))) return UrlUse::none;
  const auto is = [&](auto... names) { return ((type.name == names) || ...); };
  if (is("Anchor", "GeoMetadata")) return UrlUse::link;
  if (is("Inline", "GeoLOD")) return UrlUse::world;
  if (is("ImageTexture")) return UrlUse::texture;
  return is("Background", "TextureBackground") ? UrlUse::picture : UrlUse::file;
}

}  // namespace

UrlFields::UrlFields(const Scene& scene) : scene_(scene) {
  bool changed = scene.proto_count() > 0;
  for (std::size_t depth = 0; changed && depth < deepest; ++depth) {
    changed = false;
    for (std::uint32_t i = 0; i < scene.proto_count(); ++i) {
      const Proto& p = scene.proto(ProtoId{i});
      const auto& declared = scene.type(p.type).fields;
      for (NodeId n : reachable(scene, p.body))
        for (const Value& v : scene.fields(n)) {
          const auto inner = v.is && !scene.is_extra(v) ? use(scene.type_id(n), v.slot) : UrlUse::none;
          if (inner == UrlUse::none) continue;
          const auto at = std::ranges::find(declared, v.text(), &FieldDef::name);
          if (at == declared.end()) continue;
          const auto slot = static_cast<std::uint16_t>(at - declared.begin());
          changed |= of_protos_.try_emplace({p.type.value, slot}, inner).second;
        }
    }
  }
}

UrlUse UrlFields::use(TypeId type, std::uint16_t slot) const {
  const auto known = of_protos_.find({type.value, slot});
  if (known != of_protos_.end()) return known->second;
  const auto& t = scene_.type(type);
  return use_by_name(t, t.fields[slot]);
}

}  // namespace wrlkit

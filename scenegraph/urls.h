// Which fields hold urls, and what these lead to.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "scenegraph/scene.h"
#include "scenegraph/walk.h"

namespace wrlkit {

/// link: a place to go to (Anchor), which is not part of the world. texture: of an ImageTexture. picture: another one.
/// file: anything else that belongs to the world.
enum class UrlUse : std::uint8_t { none, file, texture, picture, world, link };

/// Knows the fields of standard nodes, of prototypes whose values end up in one of these, and of all others that are
/// called url or somethingUrl.
class UrlFields {
 public:
  /// O(nodes in bodies of prototypes), times how deep they are nested.
  explicit UrlFields(const Scene&);

  UrlUse use(TypeId type, std::uint16_t slot) const;

 private:
  const Scene& scene_;
  std::map<std::pair<std::uint32_t, std::uint16_t>, UrlUse> of_protos_;
};

/// Calls f(Span where, std::span<const std::string_view> urls, UrlUse) for each list of urls in a scene: fields of
/// nodes, defaults of prototypes, and where an EXTERNPROTO is.
void for_each_url_list(const Scene& scene, const UrlFields& fields, auto&& f) {
  const auto list = [&](Span where, TypeId type, std::uint16_t slot, const Value& v) {
    if (v.is || v.type != FieldType::MFString || v.count == 0) return;
    if (const UrlUse use = fields.use(type, slot); use != UrlUse::none) f(where, v.text_span(), use);
  };
  for (NodeId n : all_nodes(scene))
    for (const Value& v : scene.fields(n))
      if (!scene.is_extra(v)) list(scene.where(n), scene.type_id(n), v.slot, v);
  for (std::uint32_t i = 0; i < scene.proto_count(); ++i) {
    const Proto& p = scene.proto(ProtoId{i});
    if (p.external) f(p.where, std::span<const std::string_view>(p.urls), UrlUse::world);
    const auto& declared = scene.type(p.type).fields;
    for (std::uint16_t slot = 0; slot < declared.size(); ++slot)
      if (!p.external) list(p.where, p.type, slot, declared[slot].default_value);
  }
}

}  // namespace wrlkit

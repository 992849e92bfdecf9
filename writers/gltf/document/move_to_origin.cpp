#include "writers/gltf/document/move_to_origin.h"

#include "writers/gltf/origin.h"

namespace wrlkit::gltf {
namespace {

std::optional<Vec3> chosen(const GltfOrigin& origin, const Box& world) {
  switch (origin.kind) {
    case GltfOrigin::Kind::automatic:
      return world_origin(world);
    case GltfOrigin::Kind::given:
      if (origin.at != Vec3{0, 0, 0}) return origin.at;
      break;
    case GltfOrigin::Kind::none:
      break;
  }
  return std::nullopt;
}

}  // namespace

void move_to_origin(Document& d, const GltfOrigin& origin) {
  d.origin = chosen(origin, d.world);
  if (!d.origin) return;
  std::vector<std::uint32_t> open = d.roots;
  while (!open.empty()) {
    const auto id = open.back();
    open.pop_back();
    Node& n = d.nodes[id];
    if (n.lod) open.insert(open.end(), d.lods.at(id).levels.begin(), d.lods.at(id).levels.end());
    if (n.transform == none && n.attachment == Attachment::nothing) {
      const auto below = d.children_of(n);
      open.insert(open.end(), below.begin(), below.end());
      continue;
    }
    if (n.transform == none) n.transform = d.add_transform({}, true);
    n.moved = true;
    Vec3& t = d.transforms[n.transform].translation;
    for (std::size_t i = 0; i < 3; ++i) t[i] += -(*d.origin)[i];
  }
}

}  // namespace wrlkit::gltf

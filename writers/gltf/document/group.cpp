#include "writers/gltf/document/group.h"

#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

/// T, then C R, then SR S, then -SR -C.
std::uint32_t add_turning(Document& d, const Makers& m, NodeId group, std::span<const std::uint32_t> children) {
  namespace t = nodes::transform;
  const Vec3 c = m.scene.get(group, t::center);
  const Quaternion sr = quaternion(m.scene.get(group, t::scaleOrientation)), back = inverse(sr);
  auto helper = [&](const Trs& trs, std::span<const std::uint32_t> held) {
    return d.add({.transform = d.add_transform(trs, true)}, held);
  };
  const auto last = helper(placed_at(rotate(back, {-c[0], -c[1], -c[2]}), back), children);
  const auto scale = helper({{0, 0, 0}, sr, m.scene.get(group, t::scale)}, {&last, 1});
  const auto rotation = helper({c, quaternion(m.scene.get(group, t::rotation)), {1, 1, 1}}, {&scale, 1});
  Node node{.source = group,
            .transform = d.add_transform({m.scene.get(group, t::translation), {}, {1, 1, 1}}, true),
            .plain = false};
  const auto id = d.add(node, {&rotation, 1});
  add_targets(m, group, id, rotation, scale);
  return id;
}

}  // namespace

bool turns_about_a_center(const Makers& m, NodeId n) {
  namespace t = nodes::transform;
  if (!m.scene.is(n, nodes::Transform) ||
      (!m.animations.moves(n, Path::rotation) && !m.animations.moves(n, Path::scale)))
    return false;
  return m.scene.get(n, t::center) != Vec3{0, 0, 0} || !quaternion(m.scene.get(n, t::scaleOrientation)).identity();
}

std::uint32_t add_group(Document& d, const Makers& m, NodeId group, const NodeTransform& local,
                        std::span<const std::uint32_t> children) {
  if (turns_about_a_center(m, group)) return add_turning(d, m, group, children);
  std::uint32_t inner = none;
  if (local.inner) {
    inner = d.add({.transform = d.add_transform(*local.inner)}, children);
    children = {&inner, 1};
  }
  const bool moves = !local.inner && m.animations.moves(group);
  const auto id =
      d.add({.source = group, .transform = d.add_transform(local.outer, moves), .plain = local.plain}, children);
  add_targets(m, group, id, id, id);
  return id;
}

void add_targets(const Makers& m, NodeId source, std::uint32_t translation, std::uint32_t rotation,
                 std::uint32_t scale) {
  if (!m.animations.moves(source)) return;
  m.animations.add_target(source, Path::translation, translation);
  m.animations.add_target(source, Path::rotation, rotation);
  m.animations.add_target(source, Path::scale, scale);
}

}  // namespace wrlkit::gltf

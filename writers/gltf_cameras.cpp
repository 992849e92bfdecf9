#include "writers/gltf_cameras.h"

#include <numbers>

#include "scenegraph/nodes.h"
#include "writers/gltf_number.h"

namespace wrlkit::gltf {
namespace {

double farthest_corner(const Vec3& p, const Box& box) {
  if (box.empty()) return 0;
  Vec3 d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = std::max(std::abs(box.low[i] - p[i]), std::abs(box.high[i] - p[i]));
  return std::hypot(d[0], d[1], d[2]);
}

}  // namespace

Visibility visibility(const Scene& scene, NodeId n) {
  namespace f = nodes::navigation_info;
  Visibility v;
  if (!n) return v;
  if (auto size = scene.get(n, f::avatarSize); !size.empty() && size[0] > 0) v.avatar_size = size[0];
  if (auto limit = scene.get(n, f::visibilityLimit); limit > 0) v.limit = limit;
  v.headlight = scene.get(n, f::headlight);
  return v;
}

Trs camera_transform(const Scene& scene, NodeId n) {
  return placed_at(scene.get(n, nodes::viewpoint::position), quaternion(scene.get(n, nodes::viewpoint::orientation)));
}

std::string_view camera_name(const Scene& scene, NodeId n) {
  auto name = scene.name(n);
  return name.empty() ? scene.get(n, nodes::viewpoint::description) : name;
}

void write_camera(JsonOut& json, const Scene& scene, const Camera& camera, const Box& world, const Visibility& v) {
  constexpr double narrow = 1e-3, wide = std::numbers::pi - 1e-3, no_world = 100;
  double fov = scene.get(camera.source, nodes::viewpoint::fieldOfView);
  double zfar = 2 * farthest_corner(camera.position, world);
  if (!(zfar > 0) || !fits_float(zfar)) zfar = no_world;
  double znear = std::clamp(v.avatar_size / 2, zfar / 1e5, zfar / 1e3);
  if (v.limit > 0 && v.limit > 2 * znear) zfar = std::min(zfar, v.limit);
  json.begin_object();
  json.member("type", "perspective");
  if (auto name = camera_name(scene, camera.source); !name.empty()) json.member("name", name);
  json.key("perspective");
  json.begin_object();
  json.member("yfov", std::isfinite(fov) ? std::clamp(fov, narrow, wide) : std::numbers::pi / 4);
  json.member("znear", static_cast<float>(znear));
  json.member("zfar", static_cast<float>(zfar));
  json.end_object();
  json.end_object();
}

}  // namespace wrlkit::gltf

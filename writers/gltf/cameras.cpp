#include "writers/gltf/cameras.h"

#include <numbers>

#include "scenegraph/nodes.h"
#include "scenegraph/transform.h"
#include "writers/gltf/number.h"

namespace wrlkit::gltf {
namespace {

double farthest_corner(const Vec3& p, const Box& box) {
  if (box.empty()) return 0;
  Vec3 d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = std::max(std::abs(box.low[i] - p[i]), std::abs(box.high[i] - p[i]));
  return std::hypot(d[0], d[1], d[2]);
}

/// Left, bottom, right, top.
std::array<double, 4> window(const Scene& scene, NodeId n) {
  auto w = scene.get(n, nodes::ortho_viewpoint::fieldOfView);
  if (w.size() < 4 || !(w[2] > w[0]) || !(w[3] > w[1])) return {-1, -1, 1, 1};
  return {w[0], w[1], w[2], w[3]};
}

/// glTF's window is centred on the camera.
Trs ortho_transform(const Scene& scene, NodeId n) {
  namespace f = nodes::ortho_viewpoint;
  const auto w = window(scene, n);
  const auto p = scene.get(n, f::position);
  const auto o = scene.get(n, f::orientation);
  const auto shift = rotation_matrix(o).point({(w[0] + w[2]) / 2, (w[1] + w[3]) / 2, 0});
  return placed_at({p[0] + shift[0], p[1] + shift[1], p[2] + shift[2]}, quaternion(o));
}

void write_window(JsonOut& json, const std::array<double, 4>& w, double scale) {
  json.members("xmag", static_cast<float>(scale * (w[2] - w[0]) / 2), "ymag",
               static_cast<float>(scale * (w[3] - w[1]) / 2));
}

void write_angle(JsonOut& json, double angle) {
  constexpr double narrow = 1e-6, wide = std::numbers::pi - 1e-3;
  json.member("yfov", std::isfinite(angle) ? std::clamp(angle, narrow, wide) : std::numbers::pi / 4);
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
  if (scene.is(n, nodes::OrthoViewpoint)) return ortho_transform(scene, n);
  return placed_at(scene.get(n, nodes::viewpoint::position), quaternion(scene.get(n, nodes::viewpoint::orientation)));
}

std::string_view camera_name(const Scene& scene, NodeId n) {
  auto name = scene.name(n);
  if (!name.empty()) return name;
  return scene.is(n, nodes::OrthoViewpoint) ? scene.get(n, nodes::ortho_viewpoint::description)
                                            : scene.get(n, nodes::viewpoint::description);
}

void write_camera(JsonOut& json, const Scene& scene, const Camera& camera, const Box& world, const Visibility& v,
                  double reach) {
  constexpr double no_world = 100;
  const bool ortho = scene.is(camera.source, nodes::OrthoViewpoint);
  double zfar = 2 * farthest_corner(camera.position, world);
  if (!(zfar > 0) || !fits_float(zfar)) zfar = no_world;
  double znear = std::clamp(v.avatar_size / 2, zfar / 1e5, zfar / 1e3);
  if (v.limit > 0 && v.limit > 2 * znear) zfar = std::min(zfar, v.limit);
  zfar = std::max(zfar, reach);
  json.object([&] {
    json.member("type", ortho ? "orthographic" : "perspective");
    if (auto name = camera_name(scene, camera.source); !name.empty()) json.member("name", name);
    json.object(ortho ? "orthographic" : "perspective", [&] {
      if (ortho)
        write_window(json, window(scene, camera.source), camera.scale);
      else
        write_angle(json, scene.get(camera.source, nodes::viewpoint::fieldOfView));
      json.members("znear", static_cast<float>(znear), "zfar", static_cast<float>(zfar));
    });
  });
}

}  // namespace wrlkit::gltf

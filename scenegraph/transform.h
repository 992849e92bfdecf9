// The matrix of a Transform (ISO/IEC 14772-1, 6.52).
#pragma once
#include "base/math/matrix.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// The values of a Transform node.
struct TransformFields {
  Vec3 translation{0, 0, 0};
  Vec4 rotation{0, 0, 1, 0};
  Vec3 scale{1, 1, 1};
  Vec4 scale_orientation{0, 0, 1, 0};
  Vec3 center{0, 0, 0};

  bool is_identity() const { return translation == Vec3{} && rotation[3] == 0 && !scales(); }
  bool scales() const { return scale != Vec3{1, 1, 1}; }
  bool operator==(const TransformFields&) const = default;
};

/// T C R SR S -SR -C.
inline Matrix matrix_of(const TransformFields& f) {
  const auto &t = f.translation, &c = f.center;
  const auto& o = f.scale_orientation;
  Matrix linear = rotation_matrix(f.rotation);
  if (f.scales())
    linear = linear * rotation_matrix(o) * scale_matrix(f.scale) * rotation_matrix({o[0], o[1], o[2], -o[3]});
  if (c == Vec3{0, 0, 0}) return translation_matrix(t) * linear;
  return translation_matrix({t[0] + c[0], t[1] + c[1], t[2] + c[2]}) * linear *
         translation_matrix({-c[0], -c[1], -c[2]});
}

/// The matrix of a Transform node; identity for other nodes.
inline Matrix local_matrix(const Scene& scene, NodeId n) {
  namespace f = nodes::transform;
  if (!scene.is(n, nodes::Transform)) return {};
  return matrix_of({scene.get(n, f::translation), scene.get(n, f::rotation), scene.get(n, f::scale),
                    scene.get(n, f::scaleOrientation), scene.get(n, f::center)});
}

}  // namespace wrlkit

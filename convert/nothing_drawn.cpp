#include "convert/nothing_drawn.h"

#include <algorithm>
#include <string>
#include <utility>

#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// A node that is not known, or one of X3D that is drawn by browsers and not by us.
bool should_be_drawn(const Scene& scene, NodeId n) {
  return scene.type(n).kind == NodeKind::unknown || (scene.is(n, nodes::X3DShapeNode) && !scene.is(n, nodes::Shape));
}

/// Shapes with geometry that something shows; not those in nodes and fields that are not known.
bool has_geometry(const Scene& scene) {
  bool has_any = false;
  for_each_place(scene, Shown::all, [&](NodeId shape, const Matrix&) {
    has_any |= scene.is(scene.get(shape, nodes::shape::geometry), nodes::X3DGeometryNode);
  });
  return has_any;
}

/// Anywhere, and be it in a field that is not known.
bool holds_geometry(const Scene& scene) {
  return std::ranges::any_of(reachable(scene, scene.main), [&](NodeId n) {
    return scene.is(n, nodes::X3DGeometryNode) || scene.is(n, nodes::X3DShapeNode);
  });
}

std::string no_picture(std::string_view type) {
  return "it has no geometry, but a node '" + std::string(type) + "', which is not drawn";
}

void say_why_empty(const Scene& scene, Diagnostics& diag) {
  const auto& roots = scene.main.roots;
  const auto all = reachable(scene, scene.main);
  const auto undrawn = std::ranges::find_if(all, [&](NodeId n) { return should_be_drawn(scene, n); });
  if (undrawn != all.end())
    diag.report(Diag::nothing_drawn, scene.where(*undrawn), no_picture(scene.type(*undrawn).name));
  else if (diag.count(Diag::unknown_field) > 0 && holds_geometry(scene))
    diag.report(Diag::nothing_drawn, roots.empty() ? scene.file : scene.where(roots[0]),
                "it has no geometry, but fields that are not known");
  else if (diag.count(Diag::unknown_node) > 0)
    diag.report(Diag::nothing_drawn, roots.empty() ? scene.file : scene.where(roots[0]),
                "it has no geometry, but nodes that are not known");
  else if (roots.empty() && scene.proto_count() == 0)
    diag.report(Diag::nothing_drawn, scene.file, "it holds no node");
}

}  // namespace

DrawnMeshes::DrawnMeshes(const Scene& scene, MeshSource meshes, Diagnostics& diag, std::size_t n_before)
    : scene_(scene), meshes_(std::move(meshes)), diag_(diag), n_before_(n_before) {}

std::size_t DrawnMeshes::n_dropped(const Diagnostics& diag) {
  std::size_t n = 0;
  for (const auto message : {Diag::bad_index, Diag::degenerate_face, Diag::degenerate_line, Diag::short_height})
    n += diag.count(message);
  return n;
}

const Mesh& DrawnMeshes::operator()(NodeId geometry) {
  const Mesh& mesh = meshes_(geometry);
  is_any_drawn_ |= !mesh.corners.empty();
  if (!first_) first_ = geometry;
  return mesh;
}

void DrawnMeshes::report() const {
  if (is_any_drawn_) return;
  if (n_dropped(diag_) > n_before_)
    diag_.report(Diag::nothing_drawn, first_ ? scene_.where(first_) : scene_.file,
                 "all its faces, lines and points are dropped");
  else if (!has_geometry(scene_))
    say_why_empty(scene_, diag_);
}

}  // namespace wrlkit

#include "passes/lower_x3d/generated_texcoords.h"

#include <set>
#include <string>

#include "geometry/geometry.h"
#include "geometry/tessellation.h"
#include "passes/normals/normals.h"
#include "scenegraph/any_node.h"
#include "scenegraph/driven.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

NodeId generator_of(const Scene& scene, NodeId n) {
  if (scene.type(n).kind != NodeKind::builtin || !is_geometry(scene, n)) return {};
  const auto slot = scene.type(n).find("texCoord", Dialect::x3d);
  const Value* v = slot ? scene.find(n, *slot) : nullptr;
  const bool has_one = v && !v->is && v->type == FieldType::SFNode;
  return has_one && scene.is(v->node, nodes::TextureCoordinateGenerator) ? v->node : NodeId{};
}

/// S and T of each corner, from the first two numbers of something that it has.
template <class At>
void make(Mesh& mesh, std::span<const std::uint32_t> index, std::size_t count, At at) {
  mesh.texcoord.clear();
  mesh.texcoord.index.assign(index.begin(), index.end());
  for (std::uint32_t i = 0; i < count; ++i)
    for (const double number : at(i)) mesh.texcoord.values.push_back(static_cast<float>(number));
}

/// Of the modes that no fixed coordinates can stand for.
void report(const Scene& scene, NodeId generator, std::string_view mode, Diagnostics& diag) {
  const std::string why =
      mode.starts_with("NOISE") ? "the standard does not define its noise" : "it depends on the viewer";
  diag.report(Diag::drawn_otherwise, scene.where(generator),
              "the picture of a TextureCoordinateGenerator with mode '" + std::string(mode) + "'",
              "over the bounding box, because " + why);
}

}  // namespace

bool make_generated_texcoords(Scene& scene, PassContext& ctx) {
  if (!any_node(scene, [&](NodeId n) { return scene.is(n, nodes::TextureCoordinateGenerator); })) return false;
  const auto driven = driven_geometry(scene);
  bool changed = false;
  std::set<NodeId> reported;
  Mesh mesh;
  MeshScratch scratch;
  for (NodeId n : all_nodes(scene)) {
    const NodeId generator = generator_of(scene, n);
    if (!generator || (n.value < driven.size() && driven[n.value])) continue;
    const auto mode = scene.get(generator, nodes::texture_coordinate_generator::mode);
    const bool coord = mode == "COORD", local = mode == "SPHERE-LOCAL";
    if (!coord && !local) {
      if (reported.insert(generator).second) report(scene, generator, mode, ctx.diag);
      scene.unset(n, *scene.type(n).find("texCoord", Dialect::x3d));
      changed = true;
      continue;
    }
    mesh.clear();
    MeshJob job{scene, n, mesh, scratch, ctx};
    make_mesh(job, {.triangles = false});
    if (local) normals(job, {});
    if (mesh.kind != Mesh::Kind::faces || mesh.corners.empty()) continue;
    if (coord)
      make(mesh, mesh.corners, mesh.n_positions(), [&](std::uint32_t i) {
        const Vec3 p = mesh.position(i);
        return Vec2{p[0], p[1]};
      });
    else
      make(mesh, mesh.normal.index, mesh.normal.count(), [&](std::uint32_t i) {
        const float* v = mesh.normal.at(i);
        return Vec2{v[0] / 2 + 0.5, v[1] / 2 + 0.5};
      });
    store_mesh(scene, n, mesh);
    changed = true;
  }
  return changed;
}

}  // namespace wrlkit::x3d

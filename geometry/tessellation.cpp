#include "geometry/tessellation.h"

#include "geometry/geometry.h"
#include "geometry/geometry_attributes.h"
#include "geometry/shapes/shapes.h"
#include "geometry/triangulation.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

using Maker = void (*)(MeshJob&, const Tessellation&);

constexpr struct {
  TypeId type;
  Maker make;
} makers[] = {
#define SHAPE(node, maker) {nodes::node, maker},
#include "scenegraph/shape_makers.def"
};

Maker find_maker(TypeId type) {
  for (const auto& m : makers)
    if (m.type == type) return m.make;
  return nullptr;
}

// Faces of a node that is not made of faces. False when it is none of those.
bool make_faces(MeshJob& job, const Tessellation& options) {
  auto make = find_maker(job.scene.type_id(job.geometry));
  if (!make) return false;
  job.mesh.clear();
  make(job, options);
  // X3D can say of every surface whether its back is seen.
  auto solid = job.scene.type(job.geometry).find("solid", Dialect::x3d);
  if (const Value* v = solid ? job.scene.find(job.geometry, *solid) : nullptr; v && !v->is)
    job.mesh.solid = v->integer != 0;
  return true;
}

bool make_texcoords(Mesh& mesh) {
  const bool had = mesh.texcoord.present();
  default_texcoords(mesh);
  return mesh.texcoord.present() != had;
}

void count(Statistics& stats, std::string_view name, std::size_t n) {
  auto i = stats.find(name);
  if (i == stats.end()) i = stats.emplace(name, 0).first;
  i->second += n;
}

}  // namespace

bool make_mesh(MeshJob& job, const Tessellation& options) {
  Mesh& mesh = job.mesh;
  bool changed = false;
  if (mesh.kind == Mesh::Kind::none) read_mesh(job);
  if (mesh.kind == Mesh::Kind::none && make_faces(job, options)) {
    changed = true;
    count(job.ctx.stats, "tessellate.shapes", 1);
  }
  if (options.texcoords && job.textured) changed |= make_texcoords(mesh);
  if (options.triangles) changed |= cut_into_triangles(job);
  if (changed && mesh.kind == Mesh::Kind::faces) count(job.ctx.stats, "tessellate.faces", mesh.n_faces());
  return changed;
}

void report_no_surface(MeshJob& job, std::string_view why) {
  job.mesh.clear();
  job.mesh.kind = Mesh::Kind::faces;
  job.ctx.diag.report(Diag::degenerate_geometry, job.scene.where(job.geometry), title(job), why);
}

}  // namespace wrlkit

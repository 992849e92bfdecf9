#include "convert/tiles/content.h"

#include <map>
#include <tuple>
#include <unordered_map>

#include "geometry/mesh_job.h"
#include "passes/merge/moved.h"
#include "passes/normals/normals.h"
#include "scenegraph/features.h"
#include "scenegraph/nodes.h"

namespace wrlkit::tiles {
namespace {

/// Pieces that agree in these become one mesh.
using Kind = std::tuple<std::uint32_t, Mesh::Kind, bool, int, bool>;

Kind kind_of(const Piece& p) {
  const Mesh& m = p.mesh;
  return {p.look, m.kind, m.solid, m.color.present() ? m.color.width : 0, m.texcoord.present()};
}

class Content {
 public:
  Content(const Vec3& origin, const Looks& looks, Diagnostics& diag)
      : origin_(origin), looks_(looks), ctx_{diag, stats_} {
    scene_.import(looks.scene());
  }

  void add(std::span<const Piece> pieces) {
    std::map<Kind, std::vector<const Piece*>> kinds;
    for (const auto& p : pieces) kinds[kind_of(p)].push_back(&p);
    for (const auto& [kind, list] : kinds) add_shape(list);
  }

  const Scene& scene() const { return scene_; }
  const Mesh& mesh(NodeId geometry) const { return meshes_.at(geometry.value); }

 private:
  void add_shape(const std::vector<const Piece*>& pieces) {
    Mesh all;
    std::vector<std::string_view> names;
    std::vector<std::int32_t> faces;
    for (const Piece* p : pieces) {
      const auto before = all.face_begin.empty() ? 0 : all.face_begin.size() - 1;
      append(all, *p);
      const auto added = static_cast<std::int32_t>(all.face_begin.size() - 1 - before);
      if (!names.empty() && names.back() == p->name) {
        faces.back() += added;
        continue;
      }
      names.push_back(p->name);
      faces.push_back(added);
    }
    if (all.kind == Mesh::Kind::faces) all.face_begin.clear();
    const NodeId shape = scene_.add(nodes::Shape);
    const NodeId geometry = scene_.add(all.kind == Mesh::Kind::lines    ? nodes::IndexedLineSet
                                       : all.kind == Mesh::Kind::points ? nodes::PointSet
                                                                        : nodes::IndexedFaceSet);
    set_features(scene_, geometry, {names, faces});
    scene_.set(shape, nodes::shape::geometry, geometry);
    if (const NodeId look = looks_.appearance(pieces[0]->look)) scene_.set(shape, nodes::shape::appearance, look);
    scene_.main.roots.push_back(shape);
    meshes_.emplace(geometry.value, std::move(all));
  }

  void append(Mesh& all, const Piece& p) {
    moved_ = p.mesh;
    auto& points = moved_.positions.edit();
    for (std::size_t i = 0; i < points.size(); ++i) points[i] -= origin_[i % 3];
    MeshJob job{scene_, {}, moved_, scratch_, ctx_};
    normals(job, {});
    append_moved(all, moved_, {}, scratch_.map);
  }

  Vec3 origin_;
  const Looks& looks_;
  Scene scene_;
  Statistics stats_;
  Task ctx_;
  std::unordered_map<std::uint32_t, Mesh> meshes_;
  Mesh moved_;
  MeshScratch scratch_;
};

}  // namespace

bool write_content(std::span<const Piece> pieces, const Vec3& origin, const Looks& looks, const GltfOptions& options,
                   Resources& pictures, const std::string& path, Diagnostics& diag, GltfSummary& summary) {
  Content content(origin, looks, diag);
  content.add(pieces);
  const MeshSource meshes = [&](NodeId geometry) -> const Mesh& { return content.mesh(geometry); };
  return write_gltf(content.scene(), meshes, options, &pictures, path, diag, &summary);
}

}  // namespace wrlkit::tiles

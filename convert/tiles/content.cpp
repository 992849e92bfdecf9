#include "convert/tiles/content.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "convert/tiles/kept_tiles.h"
#include "geometry/mesh_job.h"
#include "passes/merge/moved.h"
#include "passes/normals/normals.h"
#include "scenegraph/features.h"
#include "scenegraph/nodes.h"

namespace wrlkit::tiles {
namespace {

/// Whether it may have its colour at each vertex: of lines and points Materials mean another one.
bool is_colourable(const Piece& p) { return p.mesh.kind == Mesh::Kind::faces; }

/// Pieces that agree in these become one mesh.
using Kind = std::tuple<std::uint32_t, Mesh::Kind, bool, int, bool>;

Kind kind_of(const Piece& p) {
  const Mesh& m = p.mesh;
  return {p.look, m.kind, m.solid, m.color.present() ? m.color.width : 0, m.texcoord.present()};
}

std::vector<std::string> sources_of(std::span<const Piece> pieces) {
  std::set<std::string> out;
  for (const auto& p : pieces)
    if (p.source_size > 0) out.insert(p.name.substr(0, p.source_size));
  return {out.begin(), out.end()};
}

class Content {
 public:
  Content(const Vec3& origin, const Looks& looks, Diagnostics& diag)
      : origin_(origin), looks_(looks), ctx_{diag, stats_} {
    scene_.import(looks.scene());
  }

  void add(std::span<const Piece> pieces, std::size_t draws) {
    std::map<Kind, std::vector<const Piece*>> kinds;
    for (const auto& p : pieces) kinds[kind_of(p)].push_back(&p);
    has_colours_ = kinds.size() > draws;
    if (has_colours_) {
      kinds.clear();
      for (const auto& p : pieces) kinds[coloured_kind_of(p)].push_back(&p);
    }
    for (const auto& [kind, list] : kinds) add_shape(list);
  }

  const Scene& scene() const { return scene_; }
  const Mesh& mesh(NodeId geometry) const { return meshes_.at(geometry.value); }

 private:
  Kind coloured_kind_of(const Piece& p) const {
    Kind kind = kind_of(p);
    if (!is_coloured(p)) return kind;
    std::get<0>(kind) = looks_.family(p.look);
    std::get<3>(kind) = std::max(std::get<3>(kind), 3);
    return kind;
  }

  /// Whether its look differs from others in colour alone.
  bool is_coloured(const Piece& p) const { return is_colourable(p) && looks_.n_of_family(looks_.family(p.look)) > 1; }

  /// Its colour, at each vertex.
  void give_colour(Mesh& mesh, std::uint32_t look) const {
    const NodeId material = looks_.scene().get(looks_.appearance(look), nodes::appearance::material);
    const Vec3 colour = looks_.scene().get(material, nodes::material::diffuseColor);
    mesh.color.width = 3;
    mesh.color.values.assign(colour.begin(), colour.end());
    mesh.color.index.assign(mesh.corners.size(), 0);
  }

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
    if (has_colours_ && is_coloured(p) && !moved_.color.present()) give_colour(moved_, p.look);
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
  bool has_colours_ = false;  // pieces have their colours at the vertices
};

}  // namespace

bool write_content(std::span<const Piece> pieces, const Vec3& origin, const Looks& looks, const GltfOptions& options,
                   const ContentBudget& budget, Resources& pictures, const std::string& path, Diagnostics& diag,
                   GltfSummary& summary) {
  constexpr int largest_reduced = 1024, least_reduced = 32;  // pixels along a side
  Content content(origin, looks, diag);
  content.add(pieces, budget.draws);
  auto gltf = options;
  gltf.sources = sources_of(pieces);
  const MeshSource meshes = [&](NodeId geometry) -> const Mesh& { return content.mesh(geometry); };
  for (int size = largest_reduced;; size /= 2) {
    Diagnostics said;
    summary = {};
    const bool written = write_gltf(content.scene(), meshes, gltf, &pictures, path, said, &summary);
    std::error_code fault;
    const bool fits = std::filesystem::file_size(path, fault) <= budget.bytes;
    if (!written || fits || summary.pictures == 0 || size < least_reduced) {
      say(said_in(said), diag);
      return written;
    }
    gltf.textures.size = gltf.textures.size > 0 ? std::min(gltf.textures.size, size) : size;
  }
}

}  // namespace wrlkit::tiles

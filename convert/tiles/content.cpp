#include "convert/tiles/content.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "convert/tiles/kept_tiles.h"
#include "geometry/mesh_job.h"
#include "passes/merge/named_mesh.h"
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

/// As single precision has it: what is a place in a table stays one.
Vec3 in_floats(Vec3 v) {
  for (double& x : v) x = static_cast<float>(x);
  return v;
}

class Content {
 public:
  Content(const Vec3& origin, const Looks& looks, Diagnostics& diag)
      : origin_(origin), looks_(looks), ctx_{diag, stats_} {
    scene_.import(looks.scene());
  }

  void add(std::span<const Piece> pieces, std::vector<Repeat> repeats, std::size_t draws) {
    // Surfaces that repeat have the draws that others could do without.
    const auto fewest = kinds_of(pieces, {}, true).size();
    repeats = worthwhile(std::move(repeats), draws - std::min(draws, fewest));
    std::vector<char> is_placed(pieces.size());
    for (const auto& repeat : repeats)
      for (const auto& place : repeat.places) is_placed[place.piece] = 1;
    auto kinds = kinds_of(pieces, is_placed, false);
    has_colours_ = kinds.size() + repeats.size() > draws;
    if (has_colours_) kinds = kinds_of(pieces, is_placed, true);
    for (const auto& [kind, list] : kinds) add_shape(list);
    for (auto& repeat : repeats) add_places(pieces, repeat);
  }

  const Scene& scene() const { return scene_; }
  const Mesh& mesh(NodeId geometry) const { return meshes_.at(geometry.value); }

 private:
  using Kinds = std::map<Kind, std::vector<const Piece*>>;

  /// Of pieces that are not placed; with their colours at the vertices or without.
  Kinds kinds_of(std::span<const Piece> pieces, std::span<const char> is_placed, bool coloured) const {
    Kinds out;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (is_placed.empty() || !is_placed[i])
        out[coloured ? coloured_kind_of(pieces[i]) : kind_of(pieces[i])].push_back(&pieces[i]);
    return out;
  }

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
    NamedMesh named;
    for (const Piece* p : pieces) named.add(moved(*p), {}, p->name, scratch_.map);
    const NodeId shape = scene_.add(nodes::Shape), geometry = named.add_geometry(scene_);
    set_features(scene_, geometry, named.parts());
    Mesh all = named.take();
    if (all.kind == Mesh::Kind::faces) all.face_begin.clear();
    scene_.set(shape, nodes::shape::geometry, geometry);
    if (const NodeId look = looks_.appearance(pieces[0]->look)) scene_.set(shape, nodes::shape::appearance, look);
    scene_.main.roots.push_back(shape);
    meshes_.emplace(geometry.value, std::move(all));
  }

  /// A surface once, and a Transform for each place, with the name of its part.
  void add_places(std::span<const Piece> pieces, Repeat& repeat) {
    namespace f = nodes::transform;
    MeshJob job{scene_, {}, repeat.mesh, scratch_, ctx_};
    normals(job, {});
    const NodeId shape = scene_.add(nodes::Shape), geometry = scene_.add(nodes::IndexedFaceSet);
    scene_.set(shape, nodes::shape::geometry, geometry);
    const auto look = pieces[repeat.places[0].piece].look;
    if (const NodeId appearance = looks_.appearance(look)) scene_.set(shape, nodes::shape::appearance, appearance);
    for (const auto& [piece, where] : repeat.places) {
      const NodeId place = scene_.add(nodes::Transform);
      scene_.set_name(place, pieces[piece].name);
      scene_.set(place, f::translation, in_floats(where.translation - origin_));
      scene_.set(place, f::rotation, where.rotation);
      scene_.set(place, f::scale, in_floats(where.scale));
      scene_.set(place, f::children, std::vector<NodeId>{shape});
      scene_.main.roots.push_back(place);
    }
    meshes_.emplace(geometry.value, std::move(repeat.mesh));
  }

  /// Around the origin, with normals and its colour.
  const Mesh& moved(const Piece& p) {
    moved_ = p.mesh;
    auto& points = moved_.positions.edit();
    for (std::size_t i = 0; i < points.size(); ++i) points[i] -= origin_[i % 3];
    MeshJob job{scene_, {}, moved_, scratch_, ctx_};
    normals(job, {});
    if (has_colours_ && is_coloured(p) && !moved_.color.present()) give_colour(moved_, p.look);
    return moved_;
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

bool write_content(std::span<const Piece> pieces, std::vector<Repeat> repeats, const Vec3& origin, const Looks& looks,
                   const GltfOptions& options, const ContentBudget& budget, Resources& pictures,
                   const std::string& path, Diagnostics& diag, GltfSummary& summary) {
  constexpr int largest_reduced = 1024, least_reduced = 32;  // pixels along a side
  Content content(origin, looks, diag);
  content.add(pieces, std::move(repeats), budget.draws);
  auto gltf = options;
  gltf.sources = sources_of(pieces);
  gltf.origin.kind = GltfOrigin::Kind::none;  // a tile says where it is itself
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

#include "convert/tiles/scene_pieces.h"

#include <algorithm>
#include <optional>

#include "base/io/url.h"
#include "base/stop.h"
#include "geometry/closest_point.h"
#include "geometry/geometry.h"
#include "geometry/moved.h"
#include "geometry/simplify/pieces.h"
#include "geometry/tessellation.h"
#include "passes/normals/normals.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/looks/texture_transform_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/named_places.h"
#include "scenegraph/places/ways.h"
#include "scenegraph/tags.h"
#include "scenegraph/walk.h"

namespace wrlkit::tiles {
namespace {

/// Triangles in two halves, across the longest side of the box around their middles.
void halve(const Mesh& mesh, std::span<std::uint32_t> faces) {
  const auto triangles = triangles_of(mesh);
  const auto middle = [&](std::uint32_t f) {
    const auto c = triangles[f];
    return c[0] + c[1] + c[2];
  };
  Box box;
  for (const auto f : faces) box.add(middle(f));
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (box.size(k) > box.size(axis)) axis = k;
  std::ranges::nth_element(faces, faces.begin() + static_cast<std::ptrdiff_t>(faces.size() / 2),
                           [&](std::uint32_t a, std::uint32_t b) {
                             const double x = middle(a)[axis], y = middle(b)[axis];
                             return x != y ? x < y : a < b;
                           });
}

class ScenePieces {
 public:
  ScenePieces(Document& document, const std::string& source, std::size_t most, Looks& looks,
              const std::function<bool(const Piece&)>& put, SceneCounts& counts)
      : scene_(document.scene()),
        ctx_(document.context()),
        source_(source),
        most_(most),
        looks_(looks),
        put_(put),
        counts_(counts),
        textured_(textured_geometry(scene_)),
        look_of_(scene_.node_count()) {}

  bool run() {
    const NamedPlaces places(scene_);
    if (places.too_many()) ctx_.diag.report(Diag::expansion_limit, {}, most_visits, "places of Shapes");
    for (const auto& place : places.places()) {
      check_stop();
      read(place);
      if (piece_.mesh.corners.empty()) continue;
      const auto& path = places.name(place.path);
      piece_.source_size = static_cast<std::uint32_t>(source_.size());
      piece_.name = path.empty() ? source_ : source_ + '/' + path;
      if (!hand_out()) return false;
    }
    return true;
  }

 private:
  void read(const NamedPlace& place) {
    const NodeId geometry = scene_.get(place.shape, nodes::shape::geometry);
    mesh_.clear();
    MeshJob job{scene_, geometry, mesh_, scratch_, ctx_, textured_[geometry.value] != 0};
    make_mesh(job, {.texcoords = true});
    if (!job.textured) mesh_.texcoord.clear();
    piece_.mesh.clear();
    if (mesh_.kind == Mesh::Kind::none || mesh_.corners.empty()) return;
    append_moved(piece_.mesh, mesh_, place.frame, scratch_.map);
    if (mesh_.is_triangles()) piece_.mesh.face_begin.clear();
    piece_.mesh.crease_angle = mesh_.crease_angle;
    piece_.mesh.primitive = mesh_.primitive;
    const NodeId appearance = scene_.get(place.shape, nodes::shape::appearance);
    place_picture(piece_.mesh.texcoord, appearance);
    piece_.look = look(appearance);
  }

  /// Parts that differ in their TextureTransforms alone are one draw then.
  void place_picture(Attribute& texcoord, NodeId appearance) const {
    if (!appearance || !texcoord.present()) return;
    const NodeId transform = scene_.get(appearance, nodes::appearance::textureTransform);
    if (!transform) return;
    const TexcoordMap map = read_texture_transform(scene_, transform).map();
    for (std::size_t i = 0; i + 1 < texcoord.values.size(); i += 2) {
      const Vec2 at = map(texcoord.values[i], texcoord.values[i + 1]);
      texcoord.values[i] = static_cast<float>(at[0]);
      texcoord.values[i + 1] = static_cast<float>(at[1]);
    }
  }

  std::uint32_t look(NodeId appearance) {
    auto& known = appearance ? look_of_[appearance.value] : no_look_;
    if (!known) known = looks_.add(scene_, appearance, ctx_, ctx_.resources);
    return *known;
  }

  bool hand_out() {
    const Mesh& mesh = piece_.mesh;
    if (!mesh.is_triangles() || mesh.n_faces() <= most_) {
      ++counts_.n_pieces;
      return put_(piece_);
    }
    MeshJob job{scene_, {}, piece_.mesh, scratch_, ctx_};
    normals(job, {});  // those along the cut are of both sides
    std::vector<std::uint32_t> faces(mesh.n_faces());
    for (std::uint32_t f = 0; f < faces.size(); ++f) faces[f] = f;
    return hand_out_cut(faces);
  }

  bool hand_out_cut(std::span<std::uint32_t> faces) {
    if (faces.size() > most_) {
      halve(piece_.mesh, faces);
      return hand_out_cut(faces.first(faces.size() / 2)) && hand_out_cut(faces.subspan(faces.size() / 2));
    }
    std::ranges::sort(faces);
    std::vector<std::uint32_t> original;
    Piece part{piece_.name, piece_.look, piece_.source_size, simplify::piece_of(piece_.mesh, faces, original)};
    part.mesh.crease_angle = piece_.mesh.crease_angle;
    part.mesh.solid = piece_.mesh.solid;
    part.mesh.primitive = piece_.mesh.primitive;
    ++counts_.n_pieces;
    ++counts_.n_cut;
    return put_(part);
  }

  const Scene& scene_;
  PassContext& ctx_;
  const std::string& source_;
  std::size_t most_;
  Looks& looks_;
  const std::function<bool(const Piece&)>& put_;
  SceneCounts& counts_;
  std::vector<char> textured_;
  std::vector<std::optional<std::uint32_t>> look_of_;  // by node
  std::optional<std::uint32_t> no_look_;
  Piece piece_;
  Mesh mesh_;
  MeshScratch scratch_;
};

/// Parts, and what holds them: their names are on the way to a part.
bool is_way(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::X3DGroupingNode) || scene.is(n, nodes::Shape) || scene.is(n, nodes::Inline);
}

/// What stands among the parts of a world, and a tile has no place for.
bool is_lost(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::Anchor) || scene.is(n, nodes::Billboard)) return true;
  if (is_way(scene, n) || scene.is(n, nodes::X3DMetadataObject)) return false;
  return scene.type(n).kind != NodeKind::builtin || scene.is(n, nodes::X3DChildNode);
}

void count_lost(const Scene& scene, SceneCounts& counts) {
  if (!scene.main.routes.empty()) counts.lost["ROUTE"] += scene.main.routes.size();
  for (const NodeId n : reachable(scene, scene.main)) {
    const bool lost = is_lost(scene, n);
    if (lost) ++counts.lost[std::string(scene.type(n).name)];
    if (!lost && has_tags(scene, n)) ++counts.lost["metadata"];
    if (!lost && !is_way(scene, n) && !scene.name(n).empty()) ++counts.lost["names in Shapes"];
  }
}

/// Pictures that a pass has made become part of the texture: tiles are written when the scene is gone.
void keep_made_pictures(Scene& scene, PassContext& ctx) {
  namespace f = nodes::image_texture;
  if (!ctx.resources || ctx.resources->made().empty()) return;
  for (std::uint32_t i = 0; i < scene.node_count(); ++i) {
    const NodeId n{i};
    if (!scene.is(n, nodes::ImageTexture)) continue;
    const auto urls = scene.get(n, f::url);
    if (urls.empty() || !urls[0].starts_with(made_scheme)) continue;
    const auto picture = ctx.resources->bytes(urls.first(1), scene.where(n), ctx.diag);
    if (!picture) continue;
    const std::string url = data_url(picture->mime, picture->bytes);
    scene.set(n, f::url, std::vector<std::string_view>{url});
  }
}

/// The passes that the user wants, and those that pieces need: light is part of the pictures.
bool expand(Document& document, std::string_view passes) {
  constexpr std::string_view needed = "lower-vrml1,expand,lower-x3d,combine-lightmap,join{loose=true}";
  std::string why;
  auto pipeline = Pipeline::parse(passes.empty() ? needed : passes, why);
  if (!pipeline) return false;
  if (!passes.empty()) pipeline->complete(needed);
  if (!pipeline->run(document.scene(), document.context())) return false;
  keep_made_pictures(document.scene(), document.context());
  return true;
}

}  // namespace

bool pieces_of(Document& document, const PiecesWanted& wanted, Looks& looks,
               const std::function<bool(const Piece&)>& put, SceneCounts& counts) {
  if (!expand(document, wanted.passes)) return false;
  count_lost(document.scene(), counts);
  return ScenePieces(document, wanted.source, wanted.most, looks, put, counts).run();
}

}  // namespace wrlkit::tiles

#include "convert/tiles/coarser.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/silent_task.h"
#include "geometry/geometry.h"
#include "geometry/simplify/pieces.h"
#include "geometry/simplify/world_levels.h"
#include "passes/weld/weld.h"
#include "scenegraph/nodes.h"

namespace wrlkit::tiles {
namespace {

constexpr std::size_t share_of_lines = 10;  // of what a tile draws
constexpr std::size_t welded_at_once = 256;

bool has_surface(const Piece& p) { return p.mesh.is_triangles(); }

/// Lines and points that are too many, the smallest first.
void leave_out_lines(std::vector<Piece>& pieces, std::size_t most) {
  std::vector<std::pair<double, std::uint32_t>> lines;
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    if (!has_surface(pieces[i])) lines.emplace_back(-diagonal(bounds_of(pieces[i].mesh)), i);
  std::ranges::sort(lines);
  std::size_t n = 0;
  for (const auto& [size, i] : lines)
    if (n += n_drawn(pieces[i].mesh); n > most) pieces[i].mesh.clear();
  std::erase_if(pieces, [](const Piece& p) { return p.mesh.corners.empty(); });
}

class Coarser {
 public:
  Coarser(std::vector<Piece> pieces, const Looks& looks, Task& ctx) : pieces_(std::move(pieces)), ctx_(ctx) {
    scene_.import(looks.scene());
    for (const auto& p : pieces_) box_.unite(bounds_of(p.mesh));
    prepare();
    for (const auto& p : pieces_) geometry_.push_back(add(p, looks));
  }

  std::vector<Piece> run(std::size_t most) {
    WorldSimplifyOptions options;
    options.counts = {most};
    const WorldLevels levels(scene_, options, ctx_);
    if (!levels.points().empty()) return read(levels.scene_at(0));
    const SimplifiedWorld world(scene_, options, ctx_);
    if (world.n_points() > 0) return read(world.scene_at(0));
    return read(scene_);
  }

 private:
  /// Around the middle of all, where single precision is good; faces find their neighbours.
  void prepare() {
    const Vec3 middle = box_.centre();
    for (std::size_t begin = 0; begin < pieces_.size(); begin += welded_at_once)
      parallel_for(std::min(welded_at_once, pieces_.size() - begin), [&](std::size_t i) {
        Mesh& mesh = pieces_[begin + i].mesh;
        simplify::transform(mesh, translation_matrix(-1 * middle));
        if (mesh.primitive) {
          mesh.normal.clear();
          mesh.crease_angle = CollapseOptions{}.crease_angle;
          mesh.primitive = false;
        }
        MeshScratch scratch;
        SilentTask silent(ctx_);
        MeshJob job{scene_, {}, mesh, scratch, silent};
        weld(job, {});
      });
  }

  NodeId add(const Piece& p, const Looks& looks) {
    const NodeId shape = scene_.add(nodes::Shape), geometry = scene_.add(nodes::IndexedFaceSet);
    store_mesh(scene_, geometry, p.mesh);
    scene_.set(shape, nodes::shape::geometry, geometry);
    if (const NodeId look = looks.appearance(p.look)) scene_.set(shape, nodes::shape::appearance, look);
    scene_.main.roots.push_back(shape);
    return geometry;
  }

  /// Pieces that have left are in no Shape any more.
  std::vector<Piece> read(const Scene& scene) {
    std::vector<char> shown(scene.node_count());
    for (const NodeId shape : scene.main.roots)
      if (const NodeId geometry = scene.get(shape, nodes::shape::geometry)) shown[geometry.value] = 1;
    SurfaceReader reader(scene, ctx_);
    std::vector<Piece> out;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!shown[geometry_[i].value]) continue;
      Piece p{pieces_[i].name, pieces_[i].look, {}};
      reader.read({geometry_[i], {}}, p.mesh);
      if (p.mesh.corners.empty()) continue;
      simplify::transform(p.mesh, translation_matrix(box_.centre()));
      out.push_back(std::move(p));
    }
    return out;
  }

  std::vector<Piece> pieces_;
  Task& ctx_;
  Scene scene_;
  Box box_;
  std::vector<NodeId> geometry_;
};

}  // namespace

std::vector<Piece> coarser(std::vector<Piece> pieces, std::size_t most, const Looks& looks, Task& ctx) {
  leave_out_lines(pieces, most / share_of_lines);
  const auto lines = std::ranges::stable_partition(pieces, has_surface);
  std::vector<Piece> kept(std::make_move_iterator(lines.begin()), std::make_move_iterator(lines.end()));
  pieces.erase(lines.begin(), pieces.end());
  std::size_t n_kept = 0;
  for (const auto& p : kept) n_kept += n_drawn(p.mesh);
  if (!pieces.empty()) {
    SilentTask silent(ctx);
    auto surfaces = Coarser(std::move(pieces), looks, silent).run(most - n_kept);
    std::ranges::move(surfaces, std::back_inserter(kept));
  }
  return kept;
}

}  // namespace wrlkit::tiles

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

/// A piece that is no surface.
struct Line {
  double size;
  std::uint32_t piece;
  std::size_t n_drawn;
};

/// The largest first.
std::vector<Line> lines_of(std::span<const Piece> pieces) {
  std::vector<Line> out;
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    if (!has_surface(pieces[i])) out.push_back({diagonal(box_of_corners(pieces[i].mesh)), i, n_drawn(pieces[i].mesh)});
  std::ranges::stable_sort(out, std::greater{}, &Line::size);
  return out;
}

class Coarser {
 public:
  Coarser(std::span<Piece> pieces, const Looks& looks, const Task& ctx)
      : pieces_(pieces), lines_(lines_of(pieces_)), silent_(ctx), geometry_(pieces_.size()) {
    scene_.import(looks.scene());
    for (const auto& p : pieces_) box_.unite(box_of_corners(p.mesh));
    prepare();
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (has_surface(pieces_[i])) geometry_[i] = add(pieces_[i], looks);
  }

  std::vector<std::vector<Coarse>> run(std::span<const std::size_t> counts) {
    std::vector<std::vector<Coarse>> out;
    std::vector<std::size_t> of_surfaces;
    for (const auto count : counts) of_surfaces.push_back(count - add_lines(out.emplace_back(), count));
    WorldSimplifyOptions options;
    options.counts = of_surfaces;
    const WorldLevels levels(scene_, options, silent_);
    const auto n_drawn = [](const auto& point) { return point.n_drawn; };
    if (!levels.points().empty())
      read_all(levels, levels.points(), n_drawn, of_surfaces, out);
    else {
      const SimplifiedWorld world(scene_, options, silent_);
      std::vector<InteractionPoint> points;
      for (std::size_t i = 0; i < world.n_points(); ++i) points.push_back(world.point(i));
      read_all(
          world, points, [](const auto& point) { return point.n_faces; }, of_surfaces, out);
    }
    for (auto& level : out) std::ranges::sort(level, {}, &Coarse::from);
    return out;
  }

 private:
  /// How much they draw.
  std::size_t add_lines(std::vector<Coarse>& to, std::size_t count) const {
    std::size_t n = 0;
    for (const auto& line : lines_) {
      if (n + line.n_drawn > count / share_of_lines) continue;
      n += line.n_drawn;
      to.push_back({line.piece, pieces_[line.piece].mesh});
      simplify::transform(to.back().mesh, translation_matrix(box_.centre()));
    }
    return n;
  }

  /// Around the middle of all, where single precision is good; faces find their neighbours.
  void prepare() {
    for (std::size_t begin = 0; begin < pieces_.size(); begin += welded_at_once)
      parallel_for(std::min(welded_at_once, pieces_.size() - begin), [&](std::size_t i) {
        Mesh& mesh = pieces_[begin + i].mesh;
        simplify::transform(mesh, translation_matrix(-1 * box_.centre()));
        if (mesh.primitive) {
          mesh.normal.clear();
          mesh.crease_angle = CollapseOptions{}.crease_angle;
          mesh.primitive = false;
        }
        MeshScratch scratch;
        SilentTask silent(static_cast<const Task&>(silent_));
        MeshJob job{scene_, {}, mesh, scratch, silent};
        weld(job, {});
      });
  }

  NodeId add(Piece& p, const Looks& looks) {
    const NodeId shape = scene_.add(nodes::Shape), geometry = scene_.add(nodes::IndexedFaceSet);
    store_mesh(scene_, geometry, p.mesh);
    p.mesh = {};
    scene_.set(shape, nodes::shape::geometry, geometry);
    if (const NodeId look = looks.appearance(p.look)) scene_.set(shape, nodes::shape::appearance, look);
    scene_.main.roots.push_back(shape);
    return geometry;
  }

  /// For each count the first point that draws no more, or the last; the scene itself where there is none.
  void read_all(const auto& world, const auto& points, const auto& n_drawn, std::span<const std::size_t> counts,
                std::vector<std::vector<Coarse>>& out) {
    for (std::size_t k = 0; k < counts.size(); ++k) {
      auto at = std::ranges::find_if(points, [&](const auto& point) { return n_drawn(point) <= counts[k]; });
      if (at == points.end() && !points.empty()) --at;
      if (at == points.end())
        read(scene_, out[k]);
      else
        read(world.scene_at(static_cast<std::size_t>(at - points.begin())), out[k]);
    }
  }

  /// Pieces that have left are in no Shape any more.
  void read(const Scene& scene, std::vector<Coarse>& out) {
    std::vector<char> shown(scene.node_count());
    for (const NodeId shape : scene.main.roots)
      if (const NodeId geometry = scene.get(shape, nodes::shape::geometry)) shown[geometry.value] = 1;
    SurfaceReader reader(scene, silent_);
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (!geometry_[i] || !shown[geometry_[i].value]) continue;
      Coarse left{i, {}};
      reader.read({geometry_[i], {}}, left.mesh);
      if (left.mesh.corners.empty()) continue;
      simplify::transform(left.mesh, translation_matrix(box_.centre()));
      out.push_back(std::move(left));
    }
  }

  std::span<Piece> pieces_;  // meshes of surfaces are in the scene
  std::vector<Line> lines_;
  SilentTask silent_;
  Scene scene_;
  Box box_;
  std::vector<NodeId> geometry_;  // by piece
};

}  // namespace

std::vector<std::vector<Coarse>> coarser(std::span<Piece> pieces, std::span<const std::size_t> counts,
                                         const Looks& looks, const Task& ctx) {
  return Coarser(pieces, looks, ctx).run(counts);
}

}  // namespace wrlkit::tiles

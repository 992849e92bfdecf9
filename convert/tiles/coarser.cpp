#include "convert/tiles/coarser.h"

#include <algorithm>
#include <numeric>

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
constexpr double step = 0.95;  // from a count to the next at which a cell may be taken

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

  std::vector<std::vector<Coarse>> run(std::span<const CoarseLevel> levels, std::size_t most) {
    std::vector<std::vector<Coarse>> out;
    std::vector<std::size_t> of_surfaces;
    for (const auto& level : levels) of_surfaces.push_back(level.count - add_lines(out.emplace_back(), level.count));
    const WorldSimplifyOptions options{.counts = with_steps(of_surfaces)};
    const WorldLevels world(scene_, options, silent_);
    if (world.points().empty())
      read_levels(SimplifiedWorld(scene_, {.counts = of_surfaces}, silent_), of_surfaces, levels, out);
    else
      read_world(world, of_surfaces, levels, most, out);
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

  /// The counts, and those between them at which cells may be taken that would draw too much.
  static std::vector<std::size_t> with_steps(std::span<const std::size_t> counts) {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const auto last = k + 1 < counts.size() ? counts[k + 1] : counts[k];
      if (counts[k] == 0) continue;
      out.push_back(counts[k]);  // less than the next where that draws more lines
      for (;;) {
        const auto count = std::min(out.back() - 1, static_cast<std::size_t>(step * static_cast<double>(out.back())));
        if (count < last || count == 0) break;
        out.push_back(count);
      }
    }
    return out;
  }

  /// That draws no more, or the last.
  static std::uint32_t first_point(std::span<const WorldLevels::Point> points, std::size_t count) {
    const auto at = std::ranges::find_if(points, [&](const auto& point) { return point.n_drawn <= count; });
    return static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(at - points.begin(), std::ssize(points) - 1));
  }

  /// For each geometry the first point from `first` on at which its cell draws no more than `most`, or the last.
  std::vector<std::uint32_t> points_of(const WorldLevels& world, std::uint32_t first, const CoarseLevel& level,
                                       std::span<const Coarse> lines, std::size_t most) const {
    std::vector<std::uint32_t> out(scene_.node_count(), WorldLevels::as_it_was);
    std::vector<std::size_t> lines_before(pieces_.size() + 1);  // what those of the pieces before draw
    for (const auto& line : lines) lines_before[line.from + 1] = n_drawn(line.mesh);
    std::partial_sum(lines_before.begin(), lines_before.end(), lines_before.begin());
    auto open = level.cells;
    for (auto point = first; !open.empty(); ++point) {
      const auto faces = world.faces_at(point);
      const bool is_last = point + 1 == world.points().size();
      std::erase_if(open, [&](const PieceRange& cell) {
        if (!is_last && drawn_in(cell, faces) + lines_before[cell.second] - lines_before[cell.first] > most)
          return false;
        for (auto i = cell.first; i < cell.second; ++i)
          if (geometry_[i]) out[geometry_[i].value] = point;
        return true;
      });
    }
    return out;
  }

  std::size_t drawn_in(const PieceRange& cell, std::span<const std::size_t> faces) const {
    std::size_t out = 0;
    for (auto i = cell.first; i < cell.second; ++i)
      if (geometry_[i]) out += faces[geometry_[i].value];
    return out;
  }

  /// Each cell of a level at its point.
  void read_world(const WorldLevels& world, std::span<const std::size_t> counts, std::span<const CoarseLevel> levels,
                  std::size_t most, std::vector<std::vector<Coarse>>& out) {
    std::vector<std::vector<std::uint32_t>> points;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const auto first = first_point(world.points(), counts[k]);
      points.push_back(points_of(world, first, levels[k], out[k], most));
    }
    std::vector<std::vector<char>> is_known(levels.size(), std::vector<char>(scene_.node_count()));
    std::vector<std::uint32_t> piece_of(scene_.node_count());
    for (std::uint32_t i = 0; i < pieces_.size(); ++i)
      if (geometry_[i]) piece_of[geometry_[i].value] = i;
    world.for_each_mesh(points, [&](std::size_t k, NodeId geometry, Mesh mesh) {
      is_known[k][geometry.value] = 1;
      add(piece_of[geometry.value], std::move(mesh), out[k]);
    });
    for (std::size_t k = 0; k < levels.size(); ++k) read(scene_, levels[k], is_known[k], out[k]);
  }

  /// Of a single part. For each level the first point that draws no more, or the last; the scene itself where there is
  /// none.
  void read_levels(const SimplifiedWorld& world, std::span<const std::size_t> counts,
                   std::span<const CoarseLevel> levels, std::vector<std::vector<Coarse>>& out) {
    const std::vector<char> none(scene_.node_count());
    for (std::size_t k = 0; k < levels.size(); ++k) {
      std::size_t at = 0;
      while (at + 1 < world.n_points() && world.point(at).n_faces > counts[k]) ++at;
      read(world.n_points() > 0 ? world.scene_at(at) : scene_, levels[k], none, out[k]);
    }
  }

  /// What is left of a piece, if anything is, back in its place.
  void add(std::uint32_t piece, Mesh mesh, std::vector<Coarse>& to) const {
    if (mesh.corners.empty()) return;
    simplify::transform(mesh, translation_matrix(box_.centre()));
    to.push_back({piece, std::move(mesh)});
  }

  /// The pieces of a level as they are in the scene, but for those of which it is known what is left.
  void read(const Scene& scene, const CoarseLevel& level, std::span<const char> is_known, std::vector<Coarse>& out) {
    SurfaceReader reader(scene, silent_);
    for (const auto& [begin, end] : level.cells)
      for (auto i = begin; i < end; ++i) {
        if (!geometry_[i] || is_known[geometry_[i].value]) continue;
        Mesh mesh;
        reader.read({geometry_[i], {}}, mesh);
        add(i, std::move(mesh), out);
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

std::vector<std::vector<Coarse>> coarser(std::span<Piece> pieces, std::span<const CoarseLevel> levels, std::size_t most,
                                         const Looks& looks, const Task& ctx) {
  return Coarser(pieces, looks, ctx).run(levels, most);
}

}  // namespace wrlkit::tiles

#include "passes/lod/cell_lods.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>

#include "base/math/saturating.h"
#include "base/silent_task.h"
#include "base/stop.h"
#include "geometry/geometry.h"
#include "geometry/simplify/world_levels.h"
#include "geometry/space_cells.h"
#include "passes/analysis/representatives.h"
#include "passes/lod/still_tree.h"
#include "passes/merge/named_mesh.h"
#include "passes/normals/normals.h"
#include "scenegraph/places/named_places.h"
#include "scenegraph/places/places.h"
#include "scenegraph/places/times_shown.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr double rounding = 0.01;        // of the error of a level, by which its points may be rounded
constexpr std::size_t least_saving = 3;  // a level of a cell has one of so many triangles of those of its children

/// To all nodes that are shown: none is followed for it.
std::uint64_t n_ways(const Scene& scene) {
  const auto shown = shown_nodes(scene);
  const auto times = times_shown(scene, shown);
  std::uint64_t out = 0;
  for (const NodeId n : shown) out = saturating_add(out, times[n.value]);
  return out;
}

/// Positions to multiples of a power of ten that is at most `step`, normals to thousandths: texts have fewer digits.
void round_values(Mesh& mesh, double step) {
  for (float& x : mesh.normal.values) x = std::round(x * 1000) / 1000;
  if (!(step > 0)) return;
  constexpr double resolution = 1e-15;  // of a double: below it there is nothing to round
  const double exponent = std::floor(std::log10(step)), power = std::pow(10., std::abs(exponent));
  if (!std::isfinite(power)) return;
  for (double& x : mesh.positions.edit()) {
    if (!(step > resolution * std::abs(x))) continue;
    x = exponent < 0 ? std::round(x * power) / power : std::round(x / power) * power;
  }
}

/// What is larger cannot be sorted by its middle, nor be written.
bool fits_in_float(const Box& box) {
  constexpr double most = std::numeric_limits<float>::max();
  const auto fits = [](double x) { return std::abs(x) <= most; };
  return std::ranges::all_of(box.low, fits) && std::ranges::all_of(box.high, fits);
}

/// What an atom of the tree shows.
struct Atom {
  std::uint32_t node;                // of the tree
  std::uint32_t first = 0, end = 0;  // of the places
  bool has_levels = true;            // all of it
};

/// A geometry, without its mesh.
struct Extent {
  bool is_known = false;
  Box box;
  std::size_t n_drawn = 0;
};

class CellLods {
 public:
  CellLods(Scene& scene, const CellLodOptions& options, Task& ctx)
      : scene_(scene),
        options_(options),
        ctx_(ctx),
        silent_(ctx),
        usage_(scene),
        places_(scene),
        tree_(scene, usage_) {}

  LodCounts run() {
    gather();
    if (atoms_.empty()) return {};
    cells_ = cut_into_cells(items_, {.drawn = options_.triangles});
    if (!make_levels()) return {};
    const NodeId lod = make_cells();
    if (!lod) return made_;
    put_together(lod);
    scene_ = std::move(out_);
    return made_;
  }

 private:
  struct Made {
    NodeId node;  // as it is shown from nearby
    Box box{};
    double error = 0;           // of the coarsest level
    std::uint64_t n_faces = 0;  // of it
  };

  void gather();
  const Extent& extent_of(NodeId geometry);
  NodeId geometry(std::uint32_t place) const {
    return scene_.get(places_.places()[place].shape, nodes::shape::geometry);
  }
  bool make_levels();
  std::vector<std::size_t> counts() const;
  std::size_t level_of(std::size_t count) const;
  NodeId make_cells();
  Made make_cell(std::uint32_t cell);
  std::vector<std::uint32_t> atoms_of(const Cell& cell) const;
  LodLevel level(std::span<const std::uint32_t> atoms, std::size_t at, bool is_leaf);
  void add_place(std::uint32_t place, std::size_t at, LodLevel& level);
  NodeId add_shape(NamedMesh& named, NodeId appearance, double step);
  NodeId group_of(const std::vector<NodeId>& children);
  void put_together(NodeId lod);

  Scene& scene_;
  const CellLodOptions& options_;
  Task& ctx_;
  SilentTask silent_;
  Usage usage_;
  NamedPlaces places_;
  StillTree tree_;
  std::vector<Extent> extents_;  // by geometry
  std::vector<Atom> atoms_;
  std::vector<SpaceItem> items_;         // by atom
  std::vector<std::uint32_t> left_out_;  // nodes of the tree that are in no cell
  Cells cells_;
  Scene out_;
  std::vector<LeveledSurface> surfaces_;
  std::vector<std::size_t> n_drawn_;                        // of the points
  std::vector<std::size_t> leaf_levels_;                    // of surfaces, behind the first
  std::vector<std::size_t> depth_levels_;                   // by the depth of a cell that is cut
  std::vector<std::uint32_t> surface_of_;                   // by Shape, from 1; 0: none
  std::vector<Made> made_of_;                               // by cell
  using Look = std::tuple<std::uint32_t, bool, int, bool>;  // Appearance, solid, width of colours, texture
  std::map<Look, std::vector<NamedMesh>> merged_;           // several only where one is full
  MeshScratch scratch_;
  std::vector<char> textured_;
  std::unique_ptr<Representatives> same_;
  LodCounts made_;
};

/// Atoms with their boxes, in the order of the file.
void CellLods::gather() {
  extents_.resize(scene_.node_count());
  textured_ = textured_geometry(scene_);
  const auto& atom_of_place = tree_.atom_of_place();
  for (std::uint32_t i = 0; i < atom_of_place.size(); ++i) {
    if (atom_of_place[i] == StillTree::none) continue;
    if (atoms_.empty() || atoms_.back().node != atom_of_place[i]) {
      atoms_.push_back({atom_of_place[i], i, i});
      items_.emplace_back();
    }
    atoms_.back().end = i + 1;
    const Extent& extent = extent_of(geometry(i));
    auto& item = items_.back();
    for (int k = 0; k < 8 && !extent.box.empty(); ++k)
      item.box.add(places_.places()[i].frame.point(extent.box.corner(k)));
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    item.n_drawn = static_cast<std::uint32_t>(std::min(saturating_add(item.n_drawn, extent.n_drawn), most));
  }
  std::size_t to = 0;
  std::vector<char> is_in(tree_.nodes().size());
  for (std::size_t i = 0; i < atoms_.size(); ++i) {
    if (!fits_in_float(items_[i].box)) continue;
    is_in[atoms_[i].node] = 1;
    atoms_[to] = atoms_[i];
    items_[to++] = items_[i];
  }
  atoms_.resize(to);
  items_.resize(to);
  for (std::uint32_t i = 0; i < is_in.size(); ++i)
    if (tree_.nodes()[i].kind != StillNode::Kind::group && !is_in[i]) left_out_.push_back(i);
}

const Extent& CellLods::extent_of(NodeId geometry) {
  check_stop();
  Extent& out = extents_[geometry.value];
  if (out.is_known) return out;
  out.is_known = true;
  Mesh mesh;
  MeshJob job{scene_, geometry, mesh, scratch_, silent_, false};
  make_mesh(job, options_.faces);
  if (mesh.corners.empty()) return out;
  out.box = box_of_corners(mesh);
  out.n_drawn = mesh.kind == Mesh::Kind::faces ? mesh.corners.size() - 2 * mesh.n_faces() : mesh.n_faces();
  return out;
}

/// Falling: those of the smallest cells, then one for each depth of the cells that they are in.
std::vector<std::size_t> CellLods::counts() const {
  const auto all = std::accumulate(items_.begin(), items_.end(), std::size_t{0},
                                   [](std::size_t n, const SpaceItem& item) { return n + item.n_drawn; });
  std::vector<std::size_t> out;
  for (const double ratio : options_.world.ratios)
    out.push_back(static_cast<std::size_t>(ratio * static_cast<double>(all)));
  std::ranges::sort(out, std::greater{});
  for (auto depth = cells_.depth; depth-- > 0;) {
    std::size_t n = 0;  // cells side by side
    for (const Cell& c : cells_.cells) n += c.depth == depth || (c.depth < depth && c.children.empty());
    out.push_back(std::min((out.empty() ? all : out.back()) / least_saving, n * options_.triangles));
  }
  return out;
}

/// Of the surfaces: the first that draws no more, or the coarsest.
std::size_t CellLods::level_of(std::size_t count) const {
  const auto at = std::ranges::find_if(n_drawn_, [&](std::size_t n) { return n <= count; });
  return std::min<std::size_t>(static_cast<std::size_t>(at - n_drawn_.begin()) + 1, n_drawn_.size());
}

bool CellLods::make_levels() {
  WorldSimplifyOptions world = options_.world;
  world.ratios.clear();
  const auto wanted = counts();
  // Each once: what is too small to be told apart is one level.
  world.counts = wanted;
  world.counts.erase(std::unique(world.counts.begin(), world.counts.end()), world.counts.end());
  world.one_part = true;
  const WorldLevels levels(scene_, world, silent_);
  if (levels.n_drawn() > WorldLevels::most_drawn)
    ctx_.diag.report(Diag::not_simplified, {},
                     fmt::format("a world of more than {} triangles as a whole", WorldLevels::most_drawn));
  if (levels.points().empty()) return false;
  for (const auto& point : levels.points()) n_drawn_.push_back(point.n_drawn);
  out_ = levels.scene_with_surfaces(surfaces_);
  const auto n_ratios = options_.world.ratios.size();
  for (std::size_t i = 0; i < wanted.size(); ++i)
    (i < n_ratios ? leaf_levels_ : depth_levels_).push_back(level_of(wanted[i]));
  std::ranges::reverse(depth_levels_);
  surface_of_.resize(out_.node_count());
  for (std::uint32_t i = 0; i < surfaces_.size(); ++i)
    for (NodeId shape : surfaces_[i].surface.shapes) surface_of_[shape.value] = i + 1;
  for (Atom& atom : atoms_)
    for (auto i = atom.first; i < atom.end; ++i) atom.has_levels &= surface_of_[places_.places()[i].shape.value] != 0;
  textured_ = textured_geometry(out_);
  same_ = std::make_unique<Representatives>(out_, usage_, reachable(out_, out_.main), false);
  return true;
}

/// In the order of the file, so that what has one name stands together.
std::vector<std::uint32_t> CellLods::atoms_of(const Cell& cell) const {
  std::vector<std::uint32_t> out(cells_.order.begin() + cell.begin, cells_.order.begin() + cell.end);
  std::ranges::sort(out);
  return out;
}

NodeId CellLods::make_cells() {
  made_of_.resize(cells_.cells.size());
  for (auto i = static_cast<std::uint32_t>(made_of_.size()); i-- > 0;) {
    check_stop();
    made_of_[i] = make_cell(i);
  }
  return made_.n_lods > 0 ? made_of_[0].node : NodeId{};
}

CellLods::Made CellLods::make_cell(std::uint32_t cell) {
  const Cell& c = cells_.cells[cell];
  const auto atoms = atoms_of(c);
  const bool is_leaf = c.children.empty();
  Made out;
  std::vector<LodLevel> levels(1);
  if (is_leaf) {
    std::vector<std::uint32_t> leaves;
    for (const auto a : atoms) {
      leaves.push_back(atoms_[a].node);
      out.box.unite(items_[a].box);
      levels[0].n_faces += items_[a].n_drawn;
    }
    levels[0].node = group_of(part_of_tree(out_, tree_, leaves));
    for (const auto at : leaf_levels_) levels.push_back(level(atoms, at, true));
  } else {
    std::vector<NodeId> below;
    for (const auto child : c.children) {
      below.push_back(made_of_[child].node);
      out.box.unite(made_of_[child].box);
      levels[0].n_faces += made_of_[child].n_faces;
      out.error = std::max(out.error, made_of_[child].error);
    }
    levels[0].node = group_of(below);
    levels.push_back(level(atoms, depth_levels_[c.depth], false));
  }
  for (std::size_t k = 1; k < levels.size(); ++k) levels[k].error = std::max(levels[k].error, out.error);
  const NodeId lod = make_lod(out_, out.box, levels, options_.limits, made_);
  out.node = lod ? lod : levels[0].node;
  out.error = lod ? levels.back().error : out.error;
  out.n_faces = lod ? levels.back().n_faces : levels[0].n_faces;
  return out;
}

/// What some atoms are at one of the levels: a mesh for each look. What has no levels is there as it is, but in a cell
/// that is cut only where it is larger than the error.
LodLevel CellLods::level(std::span<const std::uint32_t> atoms, std::size_t at, bool is_leaf) {
  LodLevel out;
  merged_.clear();
  for (const auto a : atoms)
    for (auto i = atoms_[a].first; i < atoms_[a].end && atoms_[a].has_levels; ++i) add_place(i, at, out);
  const double error = out.error;
  std::vector<std::uint32_t> kept;
  for (const auto a : atoms) {
    if (atoms_[a].has_levels) continue;
    const double size = diagonal(items_[a].box);
    if (!is_leaf && size <= error) continue;
    kept.push_back(atoms_[a].node);
    out.n_faces += items_[a].n_drawn;
  }
  std::vector<NodeId> children = part_of_tree(out_, tree_, kept);
  for (const NodeId n : reachable(out_, children))
    if (n.value >= surface_of_.size()) out_.set_name(n, {});
  for (auto& [look, meshes] : merged_)
    for (NamedMesh& named : meshes)
      children.push_back(add_shape(named, NodeId{std::get<0>(look)}, out.error * rounding));
  if (!children.empty()) out.node = group_of(children);
  out.error *= 1 + rounding;
  return out;
}

NodeId CellLods::add_shape(NamedMesh& named, NodeId appearance, double step) {
  const NodeId shape = out_.add(nodes::Shape), geometry = named.add_geometry(out_);
  if (appearance) out_.set(shape, nodes::shape::appearance, appearance);
  Mesh mesh = named.take();
  round_values(mesh, step);
  store_mesh(out_, geometry, mesh);
  set_features(out_, geometry, named.parts());
  out_.set(shape, nodes::shape::geometry, geometry);
  return shape;
}

void CellLods::add_place(std::uint32_t i, std::size_t at, LodLevel& level) {
  const auto& place = places_.places()[i];
  const auto& surface = surfaces_[surface_of_[place.shape.value] - 1];
  const auto& is = surface.levels[at];
  level.error = std::max(level.error, is.error * scale_of(place.frame));
  level.n_faces += is.n_faces;
  if (!is.geometry) return;
  Mesh mesh;
  const bool is_textured = textured_[surface.surface.geometry.value] != 0;
  MeshJob job{out_, is.geometry, mesh, scratch_, silent_, is_textured};
  make_mesh(job, options_.faces);
  if (!is_textured) mesh.texcoord.clear();
  normals(job, {});
  const NodeId appearance = same_->of(out_.get(place.shape, nodes::shape::appearance));
  const Look look{appearance.value, mesh.solid, mesh.color.present() ? mesh.color.width : 0, mesh.texcoord.present()};
  auto& meshes = merged_[look];
  const std::string_view name = places_.name(place.path);  // outlives the meshes
  if (meshes.empty() || !meshes.back().add(mesh, place.frame, name, scratch_.map))
    meshes.emplace_back().add(mesh, place.frame, name, scratch_.map);
}

NodeId CellLods::group_of(const std::vector<NodeId>& children) {
  if (children.size() == 1) return children[0];
  const NodeId group = out_.add(nodes::Group);
  out_.set(group, nodes::group::children, children);
  return group;
}

/// What is in no cell stays where it was, and the cells come behind it.
void CellLods::put_together(NodeId lod) {
  out_.main.roots = part_of_tree(out_, tree_, left_out_);
  out_.main.roots.push_back(lod);
}

}  // namespace

LodCounts add_cell_lods(Scene& scene, const CellLodOptions& options, Task& ctx) {
  if (n_ways(scene) > most_visits) {
    ctx.diag.report(Diag::not_simplified, {}, fmt::format("a world of more than {} places as a whole", most_visits));
    return {};
  }
  return CellLods(scene, options, ctx).run();
}

}  // namespace wrlkit

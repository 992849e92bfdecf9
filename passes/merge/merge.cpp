#include "passes/merge/merge.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "base/text/csv.h"
#include "geometry/geometry.h"
#include "passes/analysis/figures.h"
#include "passes/analysis/representatives.h"
#include "passes/analysis/tag_watch.h"
#include "passes/merge/cells.h"
#include "passes/merge/gltf_cost.h"
#include "passes/merge/named_mesh.h"
#include "passes/merge/part_cells.h"
#include "passes/merge/place_tables.h"
#include "passes/merge/still_places.h"
#include "passes/normals/normals.h"
#include "scenegraph/features.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/name_path.h"
#include "scenegraph/places/places.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr double large_cell = 50'000;  // corners

/// EXT_mesh_gpu_instancing knows translation, rotation and scale, and no mirror images.
bool can_be_instance(const Matrix& m) {
  double squares = 0, dots = 0;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) squares += m(r, c) * m(r, c);
  for (int c = 0; c < 3; ++c)
    dots = std::max(dots,
                    std::abs(m(0, c) * m(0, (c + 1) % 3) + m(1, c) * m(1, (c + 1) % 3) + m(2, c) * m(2, (c + 1) % 3)));
  return m.determinant() > 0 && dots <= 1e-9 * squares;
}

/// What is known of a geometry without its mesh.
struct Outline {
  bool known = false;
  std::uint64_t kind = 0;  // what has to agree; 0: nothing to draw
  std::size_t corners = 0;
  double bytes = 0;  // merged, for each place
  Vec3 centre{};
};

class Merging {
 public:
  Merging(Scene& scene, const MergeOptions& options, PassContext& ctx)
      : scene_(scene),
        options_(options),
        ctx_(ctx),
        usage_(scene),
        textured_(textured_geometry(scene)),
        still_(scene, usage_, options.parts) {}

  Outcome run() {
    const TagWatch tags(scene_);
    const Outcome out = merge();
    if (out == Outcome::changed) tags.report_lost(scene_, "merge", ctx_.diag);
    hand_in_csv();
    return out;
  }

 private:
  Outcome merge() {
    const auto before = figures_of(scene_);
    if (still_.too_many() || (!options_.instanced && !options_.parts &&
                              before.draws <= static_cast<std::size_t>(std::max(options_.max_draws, 0))))
      return Outcome::unchanged;
    names_before_ = names();
    name_parts();
    if (options_.parts)
      divide_parts();
    else
      divide();
    for (const auto& cell : cells_) merge_cell(cell);
    if (made_.empty()) {
      if (!options_.parts) report_draws_left(before);
      return Outcome::unchanged;
    }
    put_into_zones();
    remove_merged();
    if (!options_.parts) keep_lost_names();
    ctx_.stats["merge.shapes"] += n_made_;
    const auto after = figures_of(scene_);
    if (!options_.parts) report_draws_left(after);
    count_figures(ctx_, "merge", before, after);
    return Outcome::changed;
  }

  const Mesh& mesh_of(NodeId geometry);
  const Outline& outline(NodeId geometry);
  void name_parts();
  void divide();
  void divide_parts();
  void remove_from_groups();
  std::optional<std::string> names_in_geometry(std::uint32_t place) const;
  void keep_instances(std::vector<CellItem>& items, std::size_t budget);
  void merge_cell(std::vector<std::uint32_t> cell);
  void take_names(NodeId geometry, NodeId from);
  void put_into_zones();
  void remove_merged();
  std::set<std::string_view> names() const;
  void keep_lost_names();
  void report_draws_left(const SceneFigures&);
  void hand_in_csv() const;
  const StillPlace& place(std::uint32_t i) const { return still_.places()[i]; }
  NodeId geometry(std::uint32_t i) const { return scene_.get(place(i).shape, nodes::shape::geometry); }

  Scene& scene_;
  const MergeOptions& options_;
  PassContext& ctx_;
  Usage usage_;
  std::vector<char> textured_;
  StillPlaces still_;
  std::unordered_map<std::uint32_t, Outline> outlines_;
  std::vector<std::string> part_names_;  // by place
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<std::uint32_t> items_;                   // places that are drawn
  std::vector<char> merged_;                           // by node: Shapes that are not needed any more
  std::map<std::uint32_t, std::vector<NodeId>> made_;  // by zone
  std::size_t n_shared_ = 0;                           // draws that figures count, and tables of places save
  std::size_t n_made_ = 0, n_empty_ = 0;               // n_empty_: places of Shapes that draw nothing
  std::set<std::string_view> names_before_;
  std::set<std::string> merged_parts_;
  Mesh mesh_;
  MeshScratch scratch_;
};

/// As it is drawn: faces with their normals.
const Mesh& Merging::mesh_of(NodeId g) {
  mesh_.clear();
  MeshJob job{scene_, g, mesh_, scratch_, ctx_, textured_[g.value] != 0};
  make_mesh(job, options_.faces);
  normals(job, {});
  if (!job.textured) mesh_.texcoord.clear();
  return mesh_;
}

const Outline& Merging::outline(NodeId g) {
  Outline& o = outlines_[g.value];
  if (o.known) return o;
  o.known = true;
  const Mesh& m = mesh_of(g);
  if (m.corners.empty() || m.kind == Mesh::Kind::none) return o;
  o.kind = static_cast<std::uint64_t>(m.kind) * 64 + m.solid * 32 + m.color.present() * (m.color.width == 4 ? 16 : 8) +
           m.normal.present() * 2 + m.texcoord.present();
  o.corners = m.corners.size();
  o.bytes = gltf_cost::point * static_cast<double>(std::min(m.n_positions(), o.corners)) +
            gltf_cost::corner * static_cast<double>(o.corners);
  o.centre = box_of_corners(m).centre();
  return o;
}

/// All Shapes below one node with a name are one part; what has another path but the same names is another one.
void Merging::name_parts() {
  std::unordered_map<std::string, std::size_t> times;
  std::unordered_map<std::uint32_t, std::string> of_path;
  for (const StillPlace& p : still_.places()) {
    auto [at, fresh] = of_path.try_emplace(p.path);
    if (fresh) {
      at->second = still_.name(p.path);
      if (const auto n = ++times[at->second]; n > 1) at->second += "#" + std::to_string(n);
    }
    part_names_.push_back(at->second);
  }
}

void Merging::divide() {
  const Representatives same(scene_, usage_, reachable(scene_, scene_.main), false);
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>, std::uint32_t> kinds;
  std::vector<CellItem> items;
  for (std::uint32_t i = 0; i < still_.places().size(); ++i) {
    const Outline& o = outline(geometry(i));
    n_empty_ += o.kind == 0;
    if (o.kind == 0) continue;
    const auto appearance = same.of(scene_.get(place(i).shape, nodes::shape::appearance));
    const auto kind =
        kinds.try_emplace({place(i).zone, appearance.value, o.kind}, static_cast<std::uint32_t>(kinds.size()))
            .first->second;
    items.push_back({kind, still_.zones()[place(i).zone].times, place(i).frame.point(o.centre),
                     static_cast<double>(o.corners), appearance.value});
    items_.push_back(i);
  }
  const auto budget = static_cast<std::size_t>(std::max(options_.max_draws, 0));
  const auto fixed = still_.n_fixed() + n_empty_;
  const auto left = budget > fixed ? budget - fixed : 0;
  if (options_.instanced) keep_instances(items, left);
  cells_ = cells_of(items, left, options_.instanced ? large_cell : 0);
  for (auto& cell : cells_)
    for (auto& i : cell) i = items_[i];
  remove_from_groups();
}

/// A Shape whose places all are by themselves stays what it is.
void Merging::remove_from_groups() {
  merged_.resize(scene_.node_count());
  for (const auto& cell : cells_)
    if (cell.size() > 1)
      for (auto i : cell) merged_[place(i).shape.value] = 1;
}

/// The names of a geometry and its Coordinate, as one text; nothing when other names would be lost.
std::optional<std::string> Merging::names_in_geometry(std::uint32_t i) const {
  const NodeId g = geometry(i);
  if (!scene_.name(place(i).shape).empty()) return std::nullopt;
  std::string out(scene_.name(g));
  bool others = false;
  for_each_child(scene_, g, [&](NodeId c) {
    if (scene_.is(c, nodes::Coordinate))
      (out += '\n') += scene_.name(c);
    else
      others |= !scene_.name(c).empty();
  });
  return others ? std::nullopt : std::optional(out);
}

void Merging::divide_parts() {
  const Representatives same(scene_, usage_, reachable(scene_, scene_.main), false);
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint64_t, std::string>, std::uint32_t> groups;
  std::vector<PartItem> items;
  for (std::uint32_t i = 0; i < still_.places().size(); ++i) {
    const auto own_names = names_in_geometry(i);
    const Outline& o = outline(geometry(i));
    if (!own_names || o.kind == 0) continue;
    const auto appearance = same.of(scene_.get(place(i).shape, nodes::shape::appearance));
    const auto group = groups
                           .try_emplace({place(i).zone, appearance.value, o.kind, *own_names},
                                        static_cast<std::uint32_t>(groups.size()))
                           .first->second;
    items.push_back(
        {group, geometry(i).value, place(i).shape.value, std::max(still_.zones()[place(i).zone].times, 1u), o.bytes});
    items_.push_back(i);
  }
  cells_ = part_cells(items);
  for (auto& cell : cells_)
    for (auto& i : cell) i = items_[i];
  remove_from_groups();
}

/// Takes what is drawn by tables of places out of the items.
void Merging::keep_instances(std::vector<CellItem>& items, std::size_t budget) {
  std::vector<TableItem> all;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const StillPlace& p = place(items_[i]);
    const NodeId g = geometry(items_[i]);
    all.push_back(
        {items[i].kind, items[i].look, g.value, p.zone, items[i].cost, can_be_instance(p.frame), outline(g).bytes});
  }
  const PlaceTables tables = place_tables(all, budget);
  n_shared_ += tables.saved_draws;
  std::size_t to = 0;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!tables.kept[i]) {
      items[to] = items[i];
      items_[to++] = items_[i];
    }
  items.resize(to);
  items_.resize(to);
}

void Merging::merge_cell(std::vector<std::uint32_t> cell) {
  if (!merged_[place(cell[0]).shape.value]) return;
  // The Shapes of a part stand together, where the first of them is.
  std::unordered_map<std::string_view, std::uint32_t> first;
  for (auto i : cell) first.try_emplace(part_names_[i], i);
  std::ranges::stable_sort(cell, {}, [&](auto i) { return first[part_names_[i]]; });
  const NodeId appearance = scene_.get(place(cell[0]).shape, nodes::shape::appearance);
  NamedMesh all;
  for (auto i : cell) {
    all.add(mesh_of(geometry(i)), place(i).frame, part_names_[i], scratch_.map);
    merged_parts_.insert(part_names_[i]);
  }
  const NodeId geometry = all.add_geometry(scene_);
  store_mesh(scene_, geometry, all.mesh());
  if (!options_.parts)
    set_features(scene_, geometry, all.parts());
  else
    take_names(geometry, this->geometry(cell[0]));
  const NodeId shape = scene_.add(nodes::Shape, scene_.where(place(cell[0]).shape));
  if (appearance) scene_.set(shape, nodes::shape::appearance, appearance);
  scene_.set(shape, nodes::shape::geometry, geometry);
  made_[place(cell[0]).zone].push_back(shape);
  ctx_.stats["merge.parts"] += all.parts().names.size();
  ++n_made_;
}

/// What is merged has the same names.
void Merging::take_names(NodeId made, NodeId from) {
  auto coordinate = [&](NodeId g) {
    NodeId out{};
    for_each_child(scene_, g, [&](NodeId c) { out = scene_.is(c, nodes::Coordinate) ? c : out; });
    return out;
  };
  auto take = [&](NodeId to, NodeId of) {
    if (to && of && !scene_.name(of).empty()) scene_.set_name(to, std::string(scene_.name(of)));
  };
  take(made, from);
  take(coordinate(made), coordinate(from));
}

void Merging::put_into_zones() {
  for (const auto& [zone, shapes] : made_) {
    const NodeId holder = still_.zones()[zone].holder;
    if (!holder) {
      scene_.main.roots.insert(scene_.main.roots.end(), shapes.begin(), shapes.end());
      continue;
    }
    const auto slot = scene_.type(holder).find("children", Dialect::x3d);
    const auto list = scene_.value(holder, *slot).node_span();
    std::vector<NodeId> all(list.begin(), list.end());
    all.insert(all.end(), shapes.begin(), shapes.end());
    scene_.set(holder, scene_.make(FieldType::MFNode, *slot, all));
  }
}

/// And the groups that have become empty by it.
void Merging::remove_merged() {
  std::vector<char> gone(scene_.node_count());
  for (std::size_t n = 0; n < merged_.size(); ++n) gone[n] = merged_[n];
  std::vector<char> zone(scene_.node_count());
  for (const Zone& z : still_.zones())
    if (z.holder) zone[z.holder.value] = 1;
  auto is_gone = [&](NodeId n) { return n && gone[n.value]; };
  for (auto g = still_.groups().rbegin(); g != still_.groups().rend(); ++g) {
    bool any = false, left = false;
    for (const Value& v : scene_.copy_of_fields(*g)) {
      if (v.type != FieldType::MFNode || v.is || scene_.is_extra(v)) continue;
      std::vector<NodeId> list(v.node_span().begin(), v.node_span().end());
      if (std::erase_if(list, is_gone) > 0) {
        any = true;
        scene_.set(*g, scene_.make(FieldType::MFNode, v.slot, list));
      }
      left |= !list.empty();
    }
    gone[g->value] = any && !left && !zone[g->value] && !usage_.touched(*g);
  }
  std::erase_if(scene_.main.roots, is_gone);
}

std::set<std::string_view> Merging::names() const {
  std::set<std::string_view> out;
  for (NodeId n : reachable(scene_, scene_.main))
    if (!scene_.name(n).empty()) out.insert(scene_.name(n));
  return out;
}

/// Those of nodes that are neither there any more nor on the way to a part (Coordinates and the like) stay as parts
/// without faces.
void Merging::keep_lost_names() {
  const auto now = names();
  std::set<std::string> in_table;
  for (const auto& path : merged_parts_)
    for (const auto step : path_steps(path)) {
      in_table.insert(name_of_step(step));
      in_table.insert(name_of_step(step.substr(0, step.find('#'))));
    }
  const NodeId geometry = scene_.get(made_.begin()->second[0], nodes::shape::geometry);
  const auto parts = features_of(scene_, geometry);
  if (!parts) return;
  std::vector<std::string> lost;
  for (auto n : names_before_)
    if (!now.contains(n) && !in_table.contains(std::string(n))) lost.push_back(path_step(n));
  if (lost.empty()) return;
  std::vector<std::string_view> all(parts->names.begin(), parts->names.end());
  std::vector<std::int32_t> faces(parts->faces.begin(), parts->faces.end());
  all.insert(all.end(), lost.begin(), lost.end());
  faces.resize(all.size());
  set_features(scene_, geometry, {all, faces});
}

/// One draw for each appearance and place of its own is the least there can be.
void Merging::report_draws_left(const SceneFigures& left) {
  const auto draws = left.draws - n_empty_ - n_shared_, fixed = still_.n_fixed();
  if (draws <= static_cast<std::size_t>(options_.max_draws)) return;
  ctx_.diag.report(Diag::draws_left, {}, draws, options_.max_draws,
                   std::to_string(draws - std::min(fixed, draws)) + " do not look alike or move by themselves, " +
                       std::to_string(fixed) + " have to stay as they are");
}

void Merging::hand_in_csv() const {
  if (options_.csv.path.empty() || !ctx_.resources) return;
  std::string out = "id,name,appearance\n";
  // Numbers as those of glTF: by the order in which parts are drawn.
  std::map<std::string_view, std::size_t> ids;
  std::set<std::pair<std::size_t, NodeId>> said;
  for_each_place(scene_, Shown::now, [&](NodeId shape, const Matrix&) {
    const NodeId g = scene_.get(shape, nodes::shape::geometry),
                 appearance = scene_.get(shape, nodes::shape::appearance);
    const auto parts = g ? features_of(scene_, g) : std::nullopt;
    if (!parts) return;
    for (std::size_t i = 0; i < parts->names.size(); ++i) {
      const auto name = parts->names[i];
      const auto id = ids.try_emplace(name, ids.size()).first->second;
      if (parts->faces[i] > 0 && said.emplace(id, appearance).second)
        out += std::to_string(id) + ',' + csv_quoted(name) + ',' +
               csv_quoted(appearance ? scene_.name(appearance) : std::string_view()) + '\n';
    }
  });
  ctx_.resources->add_named({options_.csv.path, std::move(out)});
}

}  // namespace

Outcome merge(Scene& scene, const MergeOptions& options, PassContext& ctx) {
  return Merging(scene, options, ctx).run();
}

}  // namespace wrlkit

#include "passes/instance/instance.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "base/silent_task.h"
#include "geometry/geometry.h"
#include "passes/analysis/figures.h"
#include "passes/analysis/placed_surfaces.h"
#include "passes/analysis/text_list.h"
#include "passes/analysis/usage.h"
#include "passes/analysis/world_scales.h"
#include "passes/instance/match.h"
#include "passes/instance/share_forms.h"
#include "scenegraph/child_lists.h"
#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

using namespace instancing;

constexpr std::size_t most_compared = 16;  // groups of equal invariants that a mesh is compared with

class Instancing {
 public:
  Instancing(Scene& scene, const InstanceOptions& options, PassContext& ctx)
      : scene_(scene), options_(options), ctx_(ctx), silent_(ctx), usage_(scene), textured_(textured_geometry(scene)) {}

  Outcome run() {
    const auto before = figures_of(scene_);
    surfaces_ = placed_surfaces(scene_, usage_,
                                [&](NodeId shape, NodeId g) { return may_share(g) && can_take_metadata(shape, g); });
    scale_ = world_scales(scene_, surfaces_, ctx_.resources);
    for (std::size_t i = 0; i < surfaces_.size(); ++i) sort_in(i);
    for (const auto& g : groups_)
      if (is_worth(g)) share(g);
    if (!dropped_.empty()) replace_children(scene_, instead_);
    const std::size_t forms = options_.forms ? share_forms(scene_, options_.tolerance, options_.form_places) : 0;
    if (dropped_.empty() && forms == 0) return Outcome::unchanged;
    ctx_.stats["instance.copies"] += dropped_.size() + forms;
    if (forms > 0) ctx_.stats["instance.forms"] += forms;
    report_lost_names();
    count_figures(ctx_, "instance", before, figures_of(scene_));
    return Outcome::changed;
  }

 private:
  struct Copy {
    std::uint32_t surface;
    TransformFields where;
  };
  struct Group {
    std::uint32_t surface;  // of the first
    std::size_t bytes = 0;
    Vec3 centre{};
    double reach = 0;
    std::vector<Copy> copies;
  };

  bool is_plain(NodeId n) const { return wrlkit::is_plain(scene_, usage_, n); }
  bool may_share(NodeId geometry) const;
  bool can_take_metadata(NodeId shape, NodeId geometry) const;
  void give_metadata_to_shapes(const ShapeSurface&);
  bool read(std::uint32_t surface, Mesh& mesh, MeshForm& form);
  void sort_in(std::size_t surface);
  bool is_worth(const Group& g) const;
  void share(const Group& g);
  void report_lost_names();
  void put(const ShapeSurface& surface, const TransformFields& where, std::string_view name);

  Scene& scene_;
  const InstanceOptions& options_;
  PassContext& ctx_;
  SilentTask silent_;
  Usage usage_;
  std::vector<char> textured_;
  std::vector<ShapeSurface> surfaces_;
  std::vector<double> scale_;
  std::vector<Group> groups_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> by_cell_;
  std::unordered_map<std::uint32_t, NodeId> instead_;  // of Shapes
  MeshScratch scratch_;
  Mesh mesh_, first_mesh_;
  MeshForm form_, first_form_;
  std::vector<NodeId> dropped_;
};

bool Instancing::may_share(NodeId g) const {
  namespace ifs = nodes::indexed_face_set;
  const bool faces = scene_.is(g, nodes::IndexedFaceSet);
  if ((!faces && !scene_.is(g, nodes::IndexedLineSet) && !scene_.is(g, nodes::PointSet)) || !is_plain(g)) return false;
  bool plain = true;
  for_each_child(scene_, g, [&](NodeId c) { plain &= is_plain(c) && (options_.named || scene_.name(c).empty()); });
  if (!plain || !faces) return plain;
  if (scene_.get(g, ifs::lightCoord) || (textured_[g.value] && !scene_.get(g, ifs::texCoord))) return false;
  return options_.scaling != Scaling::axis || scene_.get(g, ifs::normal) || scene_.get(g, ifs::creaseAngle) == 0;
}

/// What is said of a geometry is said of its Shapes once others show it, too: if they have room for it.
bool Instancing::can_take_metadata(NodeId shape, NodeId geometry) const {
  bool any_below = false;
  for_each_child(scene_, geometry,
                 [&](NodeId c) { any_below |= has_tags(scene_, c) && !scene_.is(c, nodes::X3DMetadataObject); });
  if (any_below) return false;
  const auto fields = scene_.fields(geometry);
  if (std::ranges::any_of(fields, [&](const Value& v) { return scene_.is_extra(v); })) return false;
  return !has_tags(scene_, geometry) || !scene_.get(shape, nodes::shape::metadata);
}

void Instancing::give_metadata_to_shapes(const ShapeSurface& surface) {
  if (!has_tags(scene_, surface.geometry)) return;
  const auto fields = scene_.copy_of_fields(surface.geometry);
  for (const Value& v : fields) {
    if (!is_tag(scene_, surface.geometry, v)) continue;
    for (NodeId shape : surface.shapes) scene_.set(shape, nodes::shape::metadata, v.node);
    scene_.unset(surface.geometry, v.slot);
  }
}

bool Instancing::read(std::uint32_t surface, Mesh& mesh, MeshForm& form) {
  mesh.clear();
  MeshJob job{scene_, surfaces_[surface].geometry, mesh, scratch_, silent_};
  read_mesh(job);
  if (mesh.kind == Mesh::Kind::none || mesh.corners.empty()) return false;
  form.take(mesh);
  return std::isfinite(form.size);
}

void Instancing::sort_in(std::size_t surface) {
  const auto s = static_cast<std::uint32_t>(surface);
  if (!read(s, mesh_, form_)) return;
  const double tolerance = options_.tolerance / scale_[surface];
  Matcher matcher({options_.scaling, options_.mirror, tolerance});
  const auto where = cells_of(form_, options_.scaling, tolerance, true);
  std::size_t compared = 0;
  for (auto cell : where) {
    auto found = by_cell_.find(cell);
    if (found == by_cell_.end()) continue;
    for (auto g : found->second) {
      if (++compared > most_compared) break;
      if (!read(groups_[g].surface, first_mesh_, first_form_)) continue;
      if (auto fields = matcher.match(first_form_, form_)) return groups_[g].copies.push_back({s, *fields});
    }
  }
  const std::size_t vertex = mesh_.normal.present() || mesh_.kind == Mesh::Kind::faces ? 24 : 12;
  // Vertices are split at creases: something between points and corners.
  const std::size_t vertices = (mesh_.corners.size() + std::min(mesh_.corners.size(), mesh_.n_positions())) / 2;
  groups_.push_back({s, vertices * vertex + mesh_.corners.size() * 2, form_.centre, form_.reach, {}});
  by_cell_[cells_of(form_, options_.scaling, tolerance, false)[0]].push_back(
      static_cast<std::uint32_t>(groups_.size() - 1));
}

bool Instancing::is_worth(const Group& g) const {
  constexpr double transform = 150;
  double saved = 0;
  for (const Copy& c : g.copies)
    saved += static_cast<double>(g.bytes) -
             (c.where == TransformFields{} ? 0 : transform * static_cast<double>(surfaces_[c.surface].shapes.size()));
  return !g.copies.empty() && saved >= options_.min_saving;
}

void Instancing::share(const Group& g) {
  const ShapeSurface& first = surfaces_[g.surface];
  const double coarse = std::hypot(g.centre[0], g.centre[1], g.centre[2]) * 0x1p-22 * scale_[g.surface];
  const bool far = coarse > options_.tolerance && options_.tolerance > 0;
  Vec3 by{};
  if (far)
    for (std::size_t k = 0; k < 3; ++k) by[k] = std::round(g.centre[k]);
  give_metadata_to_shapes(first);
  for (const Copy& c : g.copies) {
    const ShapeSurface& copy = surfaces_[c.surface];
    give_metadata_to_shapes(copy);
    TransformFields where = c.where;
    if (far) {
      const Vec3 moved = matrix_of(where).point(by);
      where.translation = moved;
    }
    const auto name = scene_.name(copy.geometry);
    if (where == TransformFields{} && !name.empty() && name != scene_.name(first.geometry)) continue;
    dropped_.push_back(copy.geometry);
    if (where != TransformFields{}) put(copy, where, name);
    for (NodeId shape : copy.shapes) scene_.set(shape, nodes::shape::geometry, first.geometry);
  }
  ctx_.stats["instance.groups"] += 1;
  if (!far) return;
  read(g.surface, first_mesh_, first_form_);
  auto& p = first_mesh_.positions.edit();
  constexpr double decimals = 1e12;
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = std::round((p[i] - by[i % 3]) * decimals) / decimals + 0.0;
  store_mesh(scene_, first.geometry, first_mesh_);
  put(first, {.translation = by}, {});
}

/// Each Shape of a geometry into a Transform, the first of which gets a name.
void Instancing::put(const ShapeSurface& surface, const TransformFields& where, std::string_view name) {
  namespace f = nodes::transform;
  const TransformFields none;
  for (NodeId shape : surface.shapes) {
    const NodeId t = scene_.add(nodes::Transform, scene_.where(shape));
    if (where.translation != none.translation) scene_.set(t, f::translation, where.translation);
    if (where.rotation != none.rotation) scene_.set(t, f::rotation, where.rotation);
    if (where.scale != none.scale) scene_.set(t, f::scale, where.scale);
    if (where.scale_orientation != none.scale_orientation) scene_.set(t, f::scaleOrientation, where.scale_orientation);
    scene_.set(t, f::children, std::vector<NodeId>{shape});
    scene_.set_name(t, std::exchange(name, {}));
    instead_[shape.value] = t;
  }
}

/// Reports names of Coordinates and the like that nothing holds any more.
void Instancing::report_lost_names() {
  std::vector<char> seen;
  std::vector<NodeId> left;
  reach(scene_, scene_.main.roots, seen, left);
  TextList lost;
  for (NodeId g : dropped_)
    for_each_child(scene_, g, [&](NodeId n) {
      if (!seen[n.value] && !scene_.name(n).empty()) lost.add(scene_.name(n));
    });
  if (!lost.empty()) ctx_.diag.report(Diag::names_lost, {}, "instance", lost.count(), lost.text());
}

}  // namespace

Outcome instance(Scene& scene, const InstanceOptions& options, PassContext& ctx) {
  return Instancing(scene, options, ctx).run();
}

}  // namespace wrlkit

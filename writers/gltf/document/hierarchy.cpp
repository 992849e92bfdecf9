#include "writers/gltf/document/hierarchy.h"

#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "writers/gltf/document/fold.h"
#include "writers/gltf/document/group.h"
#include "writers/gltf/document/levels.h"
#include "writers/gltf/document/sky.h"
#include "writers/gltf/number.h"

namespace wrlkit::gltf {
namespace {

/// Nodes that have no counterpart and do not miss one: their content is kept, and nothing changes for a viewer.
bool harmless(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::WorldInfo) || scene.is(n, nodes::NavigationInfo) || scene.is(n, nodes::Inline) ||
         scene.is(n, nodes::X3DMetadataObject);
}

Vec3 position(const Matrix& m) { return {m.m[3], m.m[7], m.m[11]}; }

class Builder {
 public:
  explicit Builder(const Makers& makers)
      : m_(makers), visited_(makers.scene.node_count(), 0), became_(makers.scene.node_count() + 1, none) {}

  Document build() {
    frames_.push_back({.node = {}, .children = m_.scene.main.roots});
    while (!frames_.empty()) {
      Frame& f = frames_.back();
      if (f.next == f.children.size())
        leave();
      else if (NodeId n = f.children[f.next++])
        visit(n);
    }
    report_lost();
    return std::move(d_);
  }

 private:
  enum class Kind : std::uint8_t { not_known, group, shape, light, viewpoint, other };
  struct Frame {
    NodeId node{};
    std::vector<NodeId> children{};
    std::size_t next = 0;
    std::size_t first_built = 0;  // into built_
    NodeTransform local{};
    Matrix world{};                      // frame of the children
    Box box{};                           // of what they show
    bool again = false;                  // in something that was met before
    std::optional<std::size_t> shown{};  // the one child that is shown; none: all

    /// The child at hand is not shown.
    bool hides() const { return shown && next != *shown + 1; }
  };
  Kind kind(NodeId);
  bool one_too_many(NodeId);
  void visit(NodeId);
  void enter(NodeId);
  void leave();
  void set_same(std::uint32_t);
  std::uint32_t group(const Frame&);
  bool fold_into_group(const Frame&, std::uint32_t child);
  std::uint32_t shape(NodeId);
  std::uint32_t light(NodeId);
  std::uint32_t viewpoint(NodeId);
  std::uint32_t other(NodeId);
  std::uint32_t background(NodeId, std::span<const NodeId> sky);
  /// In a level of a LOD behind the first, or in what a Switch does not show?
  bool is_aside() const {
    const Frame& f = frames_.back();
    return f.hides() || (m_.scene.is(f.node, nodes::LOD) && f.next > 1);
  }
  bool keeps_hidden(NodeId n) const { return m_.keeps_hidden(n); }
  void add_built(std::uint32_t);
  bool first_visit(NodeId, bool has_place = true);
  void report_overflow(NodeId);
  void report_texcoords(NodeId geometry);
  void report_drawing(NodeId appearance, Mode mode);
  void report_group(NodeId);
  void add_lost(NodeId);
  void report_lost();

  const Makers& m_;
  Document d_;
  std::vector<Frame> frames_;
  std::vector<std::uint32_t> built_;  // nodes that are not yet children of their parents
  std::vector<Kind> kinds_;           // of types
  std::vector<char> visited_;
  std::vector<std::uint32_t> became_;             // of nodes of VRML, the first of glTF; at the end, of none
  std::map<std::string_view, std::size_t> lost_;  // by type: each Script has one of its own, but one name
  Span first_lost_;
  LostLight lost_light_;
  std::set<std::pair<std::uint32_t, std::string_view>> drawing_reported_;  // nodes and fields
  bool full_ = false;
};

void Builder::enter(NodeId n) {
  if (first_visit(n)) report_group(n);
  Frame f{.node = n, .first_built = built_.size(), .world = frames_.back().world};
  f.again = frames_.back().again || became_[n.value] != none;
  const bool chooses = m_.scene.is(n, nodes::Switch) && keeps_hidden(n);
  f.children = chooses || m_.scene.is(n, nodes::LOD) ? hierarchy_children(m_.scene, n) : shown_children(m_.scene, n);
  if (chooses && m_.extras) m_.extras->set_keeps_hidden(n);
  if (chooses) f.shown = static_cast<std::size_t>(std::max(-1, m_.scene.get(n, nodes::switch_::whichChoice)));
  if (m_.scene.is(n, nodes::Transform)) {
    f.local = node_transform(m_.scene, n);
    f.world = f.world * matrix(f.local.outer);
    if (f.local.inner) f.world = f.world * matrix(*f.local.inner);
  }
  frames_.push_back(std::move(f));
}

/// Counts positions and the like: those of geometry are counted where they are stored.
void Builder::report_overflow(NodeId n) {
  for (const Value& v : m_.scene.fields(n)) {
    const Value& c = m_.scene.content(v);
    if (c.is || info(c.type).element != Element::number || info(c.type).multiple || fits_float(c.number_span()))
      continue;
    m_.diag.report(Diag::float_overflow, m_.scene.where(n),
                   std::string(m_.scene.type(n).name) + "." + std::string(m_.scene.field_name(n, v)));
  }
}

void Builder::report_group(NodeId n) {
  if (does_something(m_.scene, n) && !m_.animations.events().begins(n)) add_lost(n);
  // Switches that no file has written only hold what prototypes leave behind.
  bool hides =
      m_.scene.is(n, nodes::Switch) && hierarchy_children(m_.scene, n).size() > shown_children(m_.scene, n).size();
  if (hides && !keeps_hidden(n) && m_.scene.where(n)) m_.diag.report(Diag::no_gltf_choice, m_.scene.where(n));
}

/// Texture coordinates that a rule makes from where the viewer is.
void Builder::report_texcoords(NodeId geometry) {
  const auto is_rule = [&](const Value& v) {
    return v.type == FieldType::SFNode && !v.is && !m_.scene.is_extra(v) &&
           m_.scene.is(v.node, nodes::TextureCoordinateGenerator);
  };
  if (std::ranges::none_of(m_.scene.fields(geometry), is_rule)) return;
  auto slot = m_.scene.type(geometry).find("texCoord", Dialect::x3d);
  const Value* v = slot ? m_.scene.find(geometry, *slot) : nullptr;
  if (v && !v->is && v->type == FieldType::SFNode && m_.scene.is(v->node, nodes::TextureCoordinateGenerator))
    m_.diag.report(Diag::no_gltf_value, m_.scene.where(v->node), m_.scene.type(geometry).name,
                   "texCoord (TextureCoordinateGenerator)");
}

/// How lines, points and hatches are drawn: glTF has only plain ones.
void Builder::report_drawing(NodeId appearance, Mode mode) {
  namespace a = nodes::appearance;
  if (!m_.scene.is(appearance, nodes::Appearance)) return;
  const auto report = [&](NodeId n, std::string_view field) {
    if (drawing_reported_.insert({n.value, field}).second)
      m_.diag.report(Diag::no_gltf_value, m_.scene.where(n), m_.scene.type(n).name, field);
  };
  const NodeId fill = m_.scene.get(appearance, a::fillProperties), line = m_.scene.get(appearance, a::lineProperties),
               point = m_.scene.get(appearance, a::pointProperties);
  if (mode == Mode::triangles && m_.scene.is(fill, nodes::FillProperties) &&
      m_.scene.get(fill, nodes::fill_properties::hatched))
    report(fill, "hatchStyle");
  if (mode == Mode::lines && m_.scene.is(line, nodes::LineProperties) &&
      m_.scene.get(line, nodes::line_properties::applied)) {
    if (m_.scene.get(line, nodes::line_properties::linewidthScaleFactor) > 1) report(line, "linewidthScaleFactor");
    if (m_.scene.get(line, nodes::line_properties::linetype) > 1) report(line, "linetype");
  }
  if (mode == Mode::points && m_.scene.is(point, nodes::PointProperties) &&
      m_.scene.get(point, nodes::point_properties::pointSizeScaleFactor) != 1)
    report(point, "pointSizeScaleFactor");
}

std::uint32_t Builder::shape(NodeId n) {
  first_visit(n);
  Node node{.source = n};
  NodeId geometry_node = m_.scene.get(n, nodes::shape::geometry);
  if (!geometry_node) return d_.add(node);
  NodeId appearance = m_.scene.get(n, nodes::shape::appearance);
  auto geometry = m_.meshes.geometry(geometry_node, m_.materials.has_picture(appearance));
  const Geometry& g = m_.meshes.geometries()[geometry];
  if (first_visit(geometry_node, !g.empty())) report_texcoords(geometry_node);
  if (g.empty()) return d_.add(node);
  if (m_.extras) m_.extras->set_shown(n);
  Frame& f = frames_.back();
  m_.meshes.note_use(geometry, f.world);
  if (!is_aside()) f.box.unite(m_.meshes.bounds(g, f.world));
  if (g.origin != none) node.transform = d_.add_transform({.translation = m_.meshes.origins()[g.origin]});
  report_drawing(appearance, g.mode);
  auto material = m_.materials.get(appearance, g.surface());
  node.attachment = Attachment::mesh;
  node.attached = m_.meshes.mesh(geometry, material);
  return d_.add(node);
}

std::uint32_t Builder::light(NodeId n) {
  Node node{.source = n,
            .transform = d_.add_transform(light_transform(m_.scene, n), m_.animations.moves(n, Path::translation))};
  bool on = m_.options.lights && shines(m_.scene, n, m_.animations.motion(), m_.animations.events().sets(n, "on"));
  if (first_visit(n) && on) lost_light_.add(m_.scene, n, frames_.size() == 1);
  if (on) {
    const Matrix& frame = frames_.back().world;
    node.attachment = Attachment::light;
    node.attached = static_cast<std::uint32_t>(d_.lights.size());
    double scale = mean_scale(frame);
    d_.lights.push_back(
        {n, position(frame * matrix(light_transform(m_.scene, n))), scale > 0 && std::isfinite(scale) ? scale : 1});
  }
  auto id = d_.add(node);
  m_.animations.add_target(n, Path::translation, id);
  return id;
}

std::uint32_t Builder::viewpoint(NodeId n) {
  first_visit(n);
  const Matrix& frame = frames_.back().world;
  Trs place = camera_transform(m_.scene, n);
  const Vec3 seen_from = position(frame * matrix(place));
  double scale = m_.scene.is(n, nodes::OrthoViewpoint) ? mean_scale(frame) : 1;
  if (!(scale > 0) || !std::isfinite(scale)) scale = 1;
  if (scale != 1) place.scale = {1 / scale, 1 / scale, 1 / scale};
  Node node{.source = n, .transform = d_.add_transform(place, m_.animations.moves(n))};
  if (m_.options.cameras) {
    node.attachment = Attachment::camera;
    node.attached = static_cast<std::uint32_t>(d_.cameras.size());
    d_.cameras.push_back({n, seen_from, scale});
  }
  auto id = d_.add(node);
  add_targets(m_, n, id, id, id);
  return id;
}

std::uint32_t Builder::other(NodeId n) {
  const auto sky = sky_shapes(m_.scene, n);
  const bool said = harmless(m_.scene, n) || !sky.empty() || m_.animations.motion().expressed(n);
  if (first_visit(n) && !said) add_lost(n);
  if (!d_.navigation_info && m_.scene.is(n, nodes::NavigationInfo)) d_.navigation_info = n;
  if (!d_.world_info && m_.scene.is(n, nodes::WorldInfo)) d_.world_info = n;
  return sky.empty() || d_.sky ? d_.add({.source = n}) : background(n, sky);
}

/// What shows it hangs below its node, which place_sky puts around the scene when that is known.
std::uint32_t Builder::background(NodeId n, std::span<const NodeId> sky) {
  frames_.push_back({.node = n});
  std::vector<std::uint32_t> children;
  for (NodeId s : sky)
    if (m_.scene.is(s, nodes::Shape)) children.push_back(shape(s));
  frames_.pop_back();
  d_.sky = Sky{d_.add({.source = n, .plain = false}, children), frames_.back().world};
  return d_.sky->node;
}

void Builder::add_lost(NodeId n) {
  if (m_.options.is_understood && m_.options.is_understood(n)) return;
  if (lost_.empty()) first_lost_ = m_.scene.where(n);
  ++lost_[m_.scene.type(n).name];
}

bool Builder::first_visit(NodeId n, bool has_place) {
  if (visited_[n.value]) return false;
  visited_[n.value] = 1;
  report_overflow(n);
  if (m_.extras && has_place) m_.extras->set_placed(n);
  return true;
}

/// In one message: a scene may have dozens of types that glTF does not know.
void Builder::report_lost() {
  std::string types;
  for (const auto& [type, n] : lost_) {
    if (!types.empty()) types += ", ";
    types += type;
    if (n > 1) types += " (" + std::to_string(n) + ")";
  }
  if (!lost_.empty()) m_.diag.report(Diag::no_gltf_node, first_lost_, types);
  lost_light_.report(m_.diag);
  if (auto n = m_.scene.main.routes.size() - m_.animations.motion().n_expressed_routes())
    m_.diag.report(Diag::no_gltf_route, {}, n);
  if (auto n = m_.scene.main.imports.size() + m_.scene.main.exports.size()) m_.diag.report(Diag::no_gltf_import, {}, n);
}

Builder::Kind Builder::kind(NodeId n) {
  auto id = m_.scene.type_id(n).value;
  if (id >= kinds_.size()) kinds_.resize(id + 1, Kind::not_known);
  if (kinds_[id] != Kind::not_known) return kinds_[id];
  const auto& t = m_.scene.type(n);
  if (t.kind == NodeKind::unknown) return hierarchy_children(m_.scene, n).empty() ? Kind::other : Kind::group;
  return kinds_[id] = t.kind != NodeKind::builtin       ? Kind::other
                      : t.is_a(nodes::X3DGroupingNode)  ? Kind::group
                      : m_.scene.is(n, nodes::Shape)    ? Kind::shape
                      : t.is_a(nodes::X3DViewpointNode) ? Kind::viewpoint
                      : is_light(m_.scene, n)           ? Kind::light
                                                        : Kind::other;
}

/// A few shared groups can show any number of nodes. Beyond the limit each node is shown once and no more.
bool Builder::one_too_many(NodeId n) {
  if (!visited_[n.value] || d_.nodes.size() + frames_.size() < m_.options.max_nodes) return false;
  if (!full_) m_.diag.report(Diag::expansion_limit, m_.scene.where(n), m_.options.max_nodes, "nodes");
  return full_ = true;
}

void Builder::visit(NodeId n) {
  if (one_too_many(n)) return;
  switch (kind(n)) {
    case Kind::group:
      return enter(n);
    case Kind::shape:
      return add_built(shape(n));
    case Kind::light:
      return add_built(light(n));
    case Kind::viewpoint:
      return add_built(viewpoint(n));
    case Kind::other:
    case Kind::not_known:
      return add_built(other(n));
  }
}

/// A child of the group at hand.
void Builder::add_built(std::uint32_t id) {
  const Frame& f = frames_.back();
  d_.nodes[id].hidden = f.hides();
  if (f.shown && m_.animations.events().sets(f.node, nodes::switch_::whichChoice.slot))
    d_.nodes[id].choice = static_cast<std::uint32_t>(f.next - 1);
  built_.push_back(id);
  set_same(id);
}

/// Notes which node this one is once more; what lies in it need not be written.
void Builder::set_same(std::uint32_t id) {
  Node& n = d_.nodes[id];
  std::uint32_t& first = became_[n.source ? n.source.value : became_.size() - 1];
  if (first == none)
    first = id;
  else if (!frames_.back().again)
    n.same_as = first;
}

void Builder::leave() {
  Frame f = std::move(frames_.back());
  frames_.pop_back();
  if (frames_.empty()) {
    d_.roots = std::move(built_);
    d_.world = f.box;
    place_sky(d_);
    return;
  }
  const auto id = group(f);
  built_.resize(f.first_built);
  if (says_nothing(m_, d_.nodes[id]) && id + 1 == d_.nodes.size() && !m_.scene.is(frames_.back().node, nodes::LOD))
    return d_.nodes.pop_back();
  add_built(id);
  if (!is_aside()) frames_.back().box.unite(f.box);
}

/// What has become part of a group is nowhere by itself any more, and cannot be there once more.
bool Builder::fold_into_group(const Frame& f, std::uint32_t child) {
  const NodeId was = d_.nodes[child].source;
  if (!fold(d_, m_, f.node, f.local, child)) return false;
  d_.nodes[child].same_as = none;
  if (was && became_[was.value] == child) became_[was.value] = none;
  return true;
}

std::uint32_t Builder::group(const Frame& f) {
  std::span<const std::uint32_t> children(built_.begin() + static_cast<std::ptrdiff_t>(f.first_built), built_.end());
  if (children.size() == 1 && fold_into_group(f, children[0])) return children[0];
  if (m_.scene.is(f.node, nodes::LOD) && children.size() > 1) {
    make_levels(d_, children, m_.scene.get(f.node, nodes::lod::range), diagonal(f.box) / 2, mean_scale(f.world));
    children = children.first(1);
  }
  return add_group(d_, m_, f.node, f.local, children);
}

}  // namespace

Document build_hierarchy(const Makers& makers) { return Builder(makers).build(); }

Vec3 offset_of(const Document& d, const Scene& scene, std::uint32_t id) {
  const Node& n = d.nodes[id];
  if (!n.source || n.transform == none) return {0, 0, 0};
  const Vec3 field = scene.is(n.source, nodes::Transform)   ? scene.get(n.source, nodes::transform::translation)
                     : scene.is(n.source, nodes::Viewpoint) ? scene.get(n.source, nodes::viewpoint::position)
                                                            : light_transform(scene, n.source).translation;
  const Vec3& at = d.transforms[n.transform].translation;
  return {at[0] - field[0], at[1] - field[1], at[2] - field[2]};
}

}  // namespace wrlkit::gltf

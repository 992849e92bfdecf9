#include "passes/recognise/recognise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

#include "base/parallel.h"
#include "base/silent_task.h"
#include "geometry/forms/form_node.h"
#include "geometry/forms/upright.h"
#include "geometry/geometry.h"
#include "geometry/recognise/pieces.h"
#include "geometry/recognise/recognise.h"
#include "passes/analysis/placed_surfaces.h"
#include "passes/analysis/usage.h"
#include "passes/analysis/world_scales.h"
#include "passes/instance/motion.h"
#include "passes/recognise/faces.h"
#include "scenegraph/child_lists.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::pair<std::string_view, std::string_view> plurals[] = {
    {"box", "boxes"},      {"cone", "cones"},     {"cylinder", "cylinders"}, {"dish", "dishes"},
    {"frustum", "frusta"}, {"prism", "prisms"},   {"pyramid", "pyramids"},   {"rectangular-torus", "rectangular-tori"},
    {"ring", "rings"},     {"sphere", "spheres"}, {"torus", "tori"},
};

struct FoundForm {
  Form form;
  TransformFields where;
  double residual = 0;
  std::size_t triangles = 0;
  std::optional<Vec4> color;  // that all its faces have
};

/// What a geometry is made of.
struct Found {
  std::vector<FoundForm> forms;
  std::optional<Mesh> rest;  // faces in none of them, when there are forms
  std::size_t triangles_left = 0, triangles = 0;
  bool solid = true;
};

TransformFields place_of(const Form& form, double step) {
  Matrix linear = form.frame;
  const Vec3 at = linear.column(3);
  for (int r = 0; r < 3; ++r) linear(r, 3) = 0;
  return instancing::in_few_digits(linear, {}, at, reach_of_form(form), std::max(step / 2, 1e-9));
}

class Recognising {
 public:
  Recognising(Scene& scene, const RecogniseFormsOptions& options, PassContext& ctx)
      : scene_(scene), options_(options), ctx_(ctx), usage_(scene), textured_(textured_geometry(scene)) {}

  Outcome run() {
    choose();
    find();
    for (std::size_t i = 0; i < surfaces_.size(); ++i) replace_geometry(i);
    if (instead_.empty()) return Outcome::unchanged;
    replace_children(scene_, instead_);
    report();
    return Outcome::changed;
  }

 private:
  void choose();
  bool is_plain(NodeId n) const { return wrlkit::is_plain(scene_, usage_, n); }
  bool may_change(NodeId geometry) const;
  bool may_color(NodeId shape) const;
  void find();
  void steps();
  template <class F>
  void in_batches(F&& f);
  void look_at(std::size_t surface, Mesh& mesh, MeshScratch& scratch, Task& task);
  void replace_geometry(std::size_t surface);
  NodeId replace_shape(NodeId shape, const Found& found, const std::vector<NodeId>& made);
  NodeId appearance_of(NodeId shape, const std::optional<Vec4>& color);
  NodeId copy_of(NodeId n);
  NodeId put(NodeId shape, NodeId geometry, NodeId appearance, const TransformFields& where);
  void count(const FoundForm& found, double scale);
  void report() const;

  Scene& scene_;
  const RecogniseFormsOptions& options_;
  PassContext& ctx_;
  Usage usage_;
  std::vector<char> textured_;
  std::vector<ShapeSurface> surfaces_;
  std::vector<double> scale_, step_;
  std::vector<Found> found_;
  std::unordered_map<std::uint32_t, NodeId> instead_;  // of Shapes
  std::map<std::pair<NodeId, Vec4>, NodeId> colored_;  // Appearances by the one that was and the colour
  std::map<std::string_view, std::size_t> kinds_;
  std::size_t triangles_ = 0;
  double residual_ = 0;
};

bool Recognising::may_change(NodeId g) const {
  namespace ifs = nodes::indexed_face_set;
  if (!scene_.is(g, nodes::IndexedFaceSet) || !is_plain(g) || textured_[g.value]) return false;
  if (scene_.get(g, ifs::lightCoord) || scene_.get(g, ifs::texCoord)) return false;
  bool plain = true;
  for_each_child(scene_, g, [&](NodeId c) { plain &= is_plain(c) && scene_.name(c).empty(); });
  return plain;
}

/// Whether a Material that nobody knows by name can take the colour of faces.
bool Recognising::may_color(NodeId shape) const {
  const NodeId appearance = scene_.get(shape, nodes::shape::appearance);
  if (!scene_.is(appearance, nodes::Appearance) || !is_plain(appearance)) return false;
  const NodeId material = scene_.get(appearance, nodes::appearance::material);
  return scene_.is(material, nodes::Material) && is_plain(material) && scene_.name(appearance).empty() &&
         scene_.name(material).empty();
}

void Recognising::choose() {
  surfaces_ = placed_surfaces(scene_, usage_, [&](NodeId shape, NodeId g) {
    return may_change(g) && (!scene_.get(g, nodes::indexed_face_set::color) || may_color(shape));
  });
}

/// The step of each geometry, or that of most of them where a few round numbers would look like a coarser one.
void Recognising::steps() {
  step_.assign(surfaces_.size(), 0);
  in_batches([&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const NodeId coord = scene_.get(surfaces_[i].geometry, nodes::indexed_face_set::coord);
      if (coord && scene_.is(coord, nodes::Coordinate))
        step_[i] = recognising::step_of(scene_.get(coord, nodes::coordinate::point));
    }
  });
  auto sorted = step_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  for (double& s : step_) s = std::min(s, *middle);
}

/// f(begin, end) for surfaces in a row, in parallel.
template <class F>
void Recognising::in_batches(F&& f) {
  constexpr std::size_t together = 64;
  parallel_for((surfaces_.size() + together - 1) / together,
               [&](std::size_t batch) { f(batch * together, std::min(surfaces_.size(), (batch + 1) * together)); });
}

void Recognising::look_at(std::size_t i, Mesh& mesh, MeshScratch& scratch, Task& task) {
  mesh.clear();
  MeshJob job{scene_, surfaces_[i].geometry, mesh, scratch, task};
  read_mesh(job);
  if (mesh.kind != Mesh::Kind::faces) return;
  Found& f = found_[i];
  f.solid = mesh.solid;
  f.triangles = triangles_in(mesh, {});
  const double step = step_[i];
  auto recognition = recognise_forms(mesh, {options_.tolerance.metres / scale_[i], step});
  auto& rest = recognition.rest;
  for (auto& r : recognition.forms) {
    const auto color = color_of(mesh, r.faces);
    if ((r.inside_out && mesh.solid) || !has_normals_of(mesh, r.faces, r.form) || (mesh.color.present() && !color)) {
      rest.insert(rest.end(), r.faces.begin(), r.faces.end());
      continue;
    }
    round_sizes(r.form, step);
    turn_upright(r.form);
    const auto triangles = triangles_in(mesh, r.faces);
    f.forms.push_back({std::move(r.form), {}, r.residual, triangles, color});
    f.forms.back().where = place_of(f.forms.back().form, step);
  }
  f.triangles_left = triangles_in(mesh, rest, true);
  if (f.forms.empty() || rest.empty()) return;
  std::ranges::sort(rest);
  f.rest = only_faces(mesh, rest);
}

/// Results lie by geometry, so that threads make no difference.
void Recognising::find() {
  scale_ = world_scales(scene_, surfaces_, ctx_.resources);
  found_.resize(surfaces_.size());
  if (surfaces_.empty()) return;
  steps();
  in_batches([&](std::size_t begin, std::size_t end) {
    SilentTask silent(ctx_);
    MeshScratch scratch;
    Mesh mesh;
    for (std::size_t i = begin; i < end && !ctx_.stop.stop_requested(); ++i) look_at(i, mesh, scratch, silent);
  });
}

/// The Appearance of a Shape with a colour instead of the diffuse one. One for each of both.
NodeId Recognising::appearance_of(NodeId shape, const std::optional<Vec4>& color) {
  namespace m = nodes::material;
  const NodeId old = scene_.get(shape, nodes::shape::appearance);
  if (!color) return old;
  NodeId& made = colored_[{old, *color}];
  if (made) return made;
  const NodeId material = copy_of(scene_.get(old, nodes::appearance::material));
  scene_.set(material, m::diffuseColor, Vec3{(*color)[0], (*color)[1], (*color)[2]});
  if ((*color)[3] >= 0) scene_.set(material, m::transparency, 1 - (*color)[3]);
  made = copy_of(old);
  scene_.set(made, nodes::appearance::material, material);
  return made;
}

NodeId Recognising::copy_of(NodeId n) {
  const auto fields = scene_.copy_of_fields(n);
  const NodeId out = scene_.add(scene_.type_id(n), scene_.where(n));
  scene_.set_fields(out, fields);
  return out;
}

/// A Transform with a Shape of that form.
NodeId Recognising::put(NodeId shape, NodeId geometry, NodeId appearance, const TransformFields& where) {
  namespace f = nodes::transform;
  const TransformFields nothing;
  const NodeId t = scene_.add(nodes::Transform, scene_.where(shape));
  if (where.translation != nothing.translation) scene_.set(t, f::translation, where.translation);
  if (where.rotation != nothing.rotation) scene_.set(t, f::rotation, where.rotation);
  if (appearance) scene_.set(shape, nodes::shape::appearance, appearance);
  scene_.set(shape, nodes::shape::geometry, geometry);
  scene_.set(t, f::children, std::vector<NodeId>{shape});
  return t;
}

void Recognising::count(const FoundForm& found, double scale) {
  ++kinds_[kind_of(found.form)];
  triangles_ += found.triangles;
  residual_ = std::max(residual_, found.residual * scale);
}

void Recognising::report() const {
  for (const auto& [kind, plural] : plurals)
    if (const auto n = kinds_.find(kind); n != kinds_.end()) {
      ctx_.stats["recognise." + std::string(plural)] += n->second;
      ctx_.stats["recognise.forms"] += n->second;
    }
  if (triangles_ > 0) ctx_.stats["recognise.triangles"] += triangles_;
  auto& residual = ctx_.stats["recognise.largest-residual"];
  residual = std::max(residual, static_cast<std::uint64_t>(std::ceil(residual_ * 1e6)));
}

void Recognising::replace_geometry(std::size_t i) {
  Found& found = found_[i];
  const NodeId old = surfaces_[i].geometry;
  const bool several = found.forms.size() + found.rest.has_value() > 1;
  if (several && (!options_.split || !scene_.name(old).empty())) {
    ctx_.stats["recognise.triangles-left"] += found.triangles;
    return;
  }
  ctx_.stats["recognise.triangles-left"] += found.triangles_left;
  if (found.forms.empty()) return;
  std::vector<NodeId> made;
  for (const auto& f : found.forms) {
    count(f, scale_[i]);
    made.push_back(add_form(scene_, f.form, found.solid, scene_.where(old)));
  }
  if (!several) scene_.set_name(made[0], scene_.name(old));
  if (found.rest) store_mesh(scene_, old, *found.rest);
  for (NodeId shape : surfaces_[i].shapes) instead_[shape.value] = replace_shape(shape, found, made);
  found = {};
}

/// The Transform or the Group that stands where a Shape stood.
NodeId Recognising::replace_shape(NodeId shape, const Found& found, const std::vector<NodeId>& made) {
  std::vector<NodeId> looks, children;
  for (const auto& f : found.forms) looks.push_back(appearance_of(shape, f.color));
  for (std::size_t k = 0; k < made.size(); ++k) {
    const bool own = k == 0 && !found.rest;
    const NodeId holder = own ? shape : scene_.add(nodes::Shape, scene_.where(shape));
    children.push_back(put(holder, made[k], looks[k], found.forms[k].where));
  }
  if (found.rest) children.push_back(shape);
  if (children.size() == 1) return children[0];
  const NodeId group = scene_.add(nodes::Group, scene_.where(shape));
  scene_.set(group, nodes::group::children, children);
  scene_.set_name(group, scene_.name(shape));
  scene_.set_name(shape, {});
  return group;
}

}  // namespace

Outcome recognise(Scene& scene, const RecogniseFormsOptions& options, PassContext& ctx) {
  return Recognising(scene, options, ctx).run();
}

}  // namespace wrlkit

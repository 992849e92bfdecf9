#include "passes/recognise/recognise.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/parallel.h"
#include "base/silent_task.h"
#include "geometry/forms/form_node.h"
#include "geometry/geometry.h"
#include "geometry/recognise/pieces.h"
#include "geometry/recognise/recognise.h"
#include "geometry/simplify/surface_scales.h"
#include "passes/analysis/usage.h"
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

struct Found {
  Recognition recognition;
  double step = 0;
  bool solid = true;
};

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
    auto& residual = ctx_.stats["recognise.largest-residual"];
    residual = std::max(residual, static_cast<std::uint64_t>(std::ceil(residual_ * 1e6)));
    return Outcome::changed;
  }

 private:
  void choose();
  bool is_plain(NodeId n) const;
  bool may_change(NodeId geometry) const;
  void find();
  void steps();
  void look_at(std::size_t surface, Mesh& mesh, MeshScratch& scratch, Task& task);
  void replace_geometry(std::size_t surface);
  NodeId put(NodeId shape, NodeId geometry, const Form& form, double step);
  void count(const RecognisedForm& found, const Mesh& mesh, double scale);

  Scene& scene_;
  const RecogniseFormsOptions& options_;
  PassContext& ctx_;
  Usage usage_;
  std::vector<char> textured_;
  std::vector<ShapeSurface> surfaces_;
  std::vector<double> scale_, step_;
  std::vector<Found> found_;
  std::unordered_map<std::uint32_t, NodeId> instead_;  // of Shapes
  MeshScratch scratch_;
  Mesh mesh_;
  double residual_ = 0;
};

bool Recognising::is_plain(NodeId n) const {
  return scene_.type(n).kind == NodeKind::builtin && !usage_.touched(n) &&
         std::ranges::none_of(scene_.fields(n), [&](const Value& v) { return v.is || scene_.is_extra(v); });
}

bool Recognising::may_change(NodeId g) const {
  namespace ifs = nodes::indexed_face_set;
  if (!scene_.is(g, nodes::IndexedFaceSet) || !is_plain(g) || textured_[g.value]) return false;
  if (scene_.get(g, ifs::lightCoord) || scene_.get(g, ifs::color) || scene_.get(g, ifs::texCoord)) return false;
  bool plain = true;
  for_each_child(scene_, g, [&](NodeId c) { plain &= is_plain(c) && scene_.name(c).empty(); });
  return plain;
}

/// Geometry of the main world whose Shapes all stand where a Transform can stand, too.
void Recognising::choose() {
  const auto nodes = reachable(scene_, scene_.main);
  std::vector<std::uint32_t> held(scene_.node_count()), number(scene_.node_count());
  auto hold = [&](std::span<const NodeId> list) {
    for (NodeId n : list)
      if (n) ++held[n.value];
  };
  hold(scene_.main.roots);
  edit_child_lists(scene_, nodes, hold);
  for (NodeId n : nodes) {
    if (!scene_.is(n, nodes::Shape) || !is_plain(n) || held[n.value] != usage_.uses(n)) continue;
    const NodeId g = scene_.get(n, nodes::shape::geometry);
    if (!g || !may_change(g)) continue;
    auto& i = number[g.value];
    if (!i) {
      surfaces_.push_back({g, {}});
      i = static_cast<std::uint32_t>(surfaces_.size());
    }
    surfaces_[i - 1].shapes.push_back(n);
  }
  std::erase_if(surfaces_, [&](const ShapeSurface& s) { return s.shapes.size() != usage_.uses(s.geometry); });
}

/// The step of each geometry, or that of most of them where a few round numbers would look like a coarser one.
void Recognising::steps() {
  step_.clear();
  for (const auto& s : surfaces_) {
    const NodeId coord = scene_.get(s.geometry, nodes::indexed_face_set::coord);
    const bool points = coord && scene_.is(coord, nodes::Coordinate);
    step_.push_back(points ? recognising::step_of(scene_.get(coord, nodes::coordinate::point)) : 0);
  }
  auto sorted = step_;
  std::ranges::sort(sorted);
  for (double& s : step_) s = std::min(s, sorted[sorted.size() / 2]);
}

void Recognising::look_at(std::size_t i, Mesh& mesh, MeshScratch& scratch, Task& task) {
  mesh.clear();
  MeshJob job{scene_, surfaces_[i].geometry, mesh, scratch, task};
  read_mesh(job);
  if (mesh.kind != Mesh::Kind::faces) return;
  Found& f = found_[i];
  f.step = step_[i];
  f.solid = mesh.solid;
  f.recognition = recognise_forms(mesh, {options_.tolerance.metres / scale_[i], f.step});
  auto& forms = f.recognition.forms;
  const auto unfit = [&](const RecognisedForm& r) {
    return (r.inside_out && mesh.solid) || !has_normals_of(mesh, r.faces, r.form);
  };
  for (const auto& r : forms)
    if (unfit(r)) f.recognition.rest.insert(f.recognition.rest.end(), r.faces.begin(), r.faces.end());
  std::erase_if(forms, unfit);
  std::ranges::sort(f.recognition.rest);
}

/// All geometry, in parallel; results lie by geometry, so that threads make no difference.
void Recognising::find() {
  constexpr std::size_t together = 64;
  scale_ = largest_scales(scene_, surfaces_);
  found_.resize(surfaces_.size());
  if (surfaces_.empty()) return;
  steps();
  parallel_for((surfaces_.size() + together - 1) / together, [&](std::size_t batch) {
    SilentTask silent(ctx_);
    MeshScratch scratch;
    Mesh mesh;
    const std::size_t end = std::min(surfaces_.size(), (batch + 1) * together);
    for (std::size_t i = batch * together; i < end && !ctx_.stop.stop_requested(); ++i)
      look_at(i, mesh, scratch, silent);
  });
}

/// A Transform with a Shape of that form.
NodeId Recognising::put(NodeId shape, NodeId geometry, const Form& form, double step) {
  namespace f = nodes::transform;
  Matrix linear = form.frame;
  const Vec3 at{linear(0, 3), linear(1, 3), linear(2, 3)};
  for (int r = 0; r < 3; ++r) linear(r, 3) = 0;
  const auto where = instancing::in_few_digits(linear, {}, at, reach_of_form(form), std::max(step / 2, 1e-9));
  const TransformFields nothing;
  const NodeId t = scene_.add(nodes::Transform, scene_.where(shape));
  if (where.translation != nothing.translation) scene_.set(t, f::translation, where.translation);
  if (where.rotation != nothing.rotation) scene_.set(t, f::rotation, where.rotation);
  scene_.set(shape, nodes::shape::geometry, geometry);
  scene_.set(t, f::children, std::vector<NodeId>{shape});
  return t;
}

void Recognising::count(const RecognisedForm& found, const Mesh& mesh, double scale) {
  const auto plural =
      std::ranges::find(plurals, kind_of(found.form), &std::pair<std::string_view, std::string_view>::first);
  ctx_.stats["recognise." + std::string(plural->second)] += 1;
  ctx_.stats["recognise.forms"] += 1;
  ctx_.stats["recognise.triangles"] += triangles_in(mesh, found.faces);
  residual_ = std::max(residual_, found.residual * scale);
}

void Recognising::replace_geometry(std::size_t i) {
  auto& found = found_[i];
  auto& forms = found.recognition.forms;
  if (forms.empty() && found.recognition.rest.empty()) return;
  const NodeId old = surfaces_[i].geometry;
  mesh_.clear();
  SilentTask silent(ctx_);
  MeshJob quiet{scene_, old, mesh_, scratch_, silent};
  read_mesh(quiet);
  const bool rest = !found.recognition.rest.empty(), several = forms.size() + rest > 1;
  if (several && !scene_.name(old).empty()) {
    ctx_.stats["recognise.triangles-left"] += triangles_in(mesh_, {});
    return;
  }
  ctx_.stats["recognise.triangles-left"] += triangles_in(mesh_, found.recognition.rest, true);
  if (forms.empty()) return;
  std::vector<NodeId> made;
  for (auto& r : forms) {
    count(r, mesh_, scale_[i]);
    round_sizes(r.form, found.step);
    made.push_back(add_form(scene_, r.form, found.solid, scene_.where(old)));
  }
  if (!several) scene_.set_name(made[0], scene_.name(old));
  if (rest) {
    const Mesh left = only_faces(mesh_, found.recognition.rest);
    store_mesh(scene_, old, left);
  }
  for (NodeId shape : surfaces_[i].shapes) {
    std::vector<NodeId> children;
    const NodeId appearance = scene_.get(shape, nodes::shape::appearance);
    for (std::size_t k = 0; k < forms.size(); ++k) {
      const bool own = k == 0 && !rest;
      const NodeId holder = own ? shape : scene_.add(nodes::Shape, scene_.where(shape));
      if (!own && appearance) scene_.set(holder, nodes::shape::appearance, appearance);
      children.push_back(put(holder, made[k], forms[k].form, found.step));
    }
    if (rest) children.push_back(shape);
    if (children.size() == 1) {
      instead_[shape.value] = children[0];
      continue;
    }
    const NodeId group = scene_.add(nodes::Group, scene_.where(shape));
    scene_.set(group, nodes::group::children, children);
    scene_.set_name(group, scene_.name(shape));
    scene_.set_name(shape, {});
    instead_[shape.value] = group;
  }
}

}  // namespace

Outcome recognise(Scene& scene, const RecogniseFormsOptions& options, PassContext& ctx) {
  return Recognising(scene, options, ctx).run();
}

}  // namespace wrlkit

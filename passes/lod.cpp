#include "passes/lod.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "passes/geometry.h"
#include "passes/tessellate.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// A geometry with a surface, the Shapes that it is in, and what is made of it.
struct Part {
  NodeId geometry;
  std::vector<NodeId> shapes;
  Mesh mesh;
  std::vector<MeshLevel> levels;
};

struct Sphere {
  Vec3 center{};
  double radius = 0;
};

/// The next number above `v` of four digits, for texts that people read.
double round_up(double v) {
  if (!(v > 0)) return 0;
  const double step = std::pow(10.0, std::floor(std::log10(v)) - 3);
  return step >= 1 ? std::ceil(v / step) * step : std::ceil(v / step) / std::round(1 / step);
}

/// Around the bounds of the positions that the corners use.
Sphere bounding_sphere(const Mesh& mesh) {
  Vec3 low{}, high{};
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = mesh.positions[mesh.corners[i] * std::size_t{3} + k];
      low[k] = i ? std::min(low[k], x) : x;
      high[k] = i ? std::max(high[k], x) : x;
    }
  Sphere s;
  for (std::size_t k = 0; k < 3; ++k) s.center[k] = static_cast<float>((low[k] + high[k]) / 2);
  for (auto c : mesh.corners) {
    double d = 0;
    for (std::size_t k = 0; k < 3; ++k) d += std::pow(mesh.positions[c * std::size_t{3} + k] - s.center[k], 2);
    s.radius = std::max(s.radius, d);
  }
  s.radius = std::sqrt(s.radius);
  return s;
}

class Lod {
 public:
  Lod(Scene& scene, const LodOptions& options, PassContext& ctx)
      : scene_(scene), options_(options), ctx_(ctx), order_(all_nodes(scene)), kept_(scene.node_count()), lod_of_(scene.node_count()) {}

  Outcome run() {
    keep_routed();
    keep_below_levels();
    auto parts = choose_parts();
    for (std::size_t i = 0; i < parts.size();) i = make_batch(std::span(parts).subspan(i)) + i;
    if (n_lods_ == 0) return Outcome::unchanged;
    replace_shapes();
    return Outcome::changed;
  }

 private:
  // What must not change: ends of ROUTEs, and everything that is a version of something already.
  void keep_routed() {
    auto keep = [&](const Scope& s) { for (const auto& r : s.routes) kept_[r.from.value] = kept_[r.to.value] = 1; };
    keep(scene_.main);
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i) keep(scene_.proto(ProtoId{i}).body);
  }

  void keep_below_levels() {
    std::vector<NodeId> todo;
    for (NodeId n : order_)
      if (scene_.is(n, nodes::LOD)) todo.push_back(n);
    std::vector<char> seen(scene_.node_count());
    while (!todo.empty()) {
      NodeId n = todo.back();
      todo.pop_back();
      for_each_child(scene_, n, [&](NodeId c) {
        if (!c || seen[c.value]) return;
        seen[c.value] = kept_[c.value] = 1;
        todo.push_back(c);
      });
    }
  }

  bool has_is(NodeId n) const {
    return std::ranges::any_of(scene_.fields(n), [&](const Value& v) { return scene_.content(v).is; });
  }

  /// Geometry whose surface is known now and stays as it is.
  bool is_fixed_surface(NodeId g) const {
    if (!g || kept_[g.value] || scene_.type(g).kind != NodeKind::builtin || scene_.is(g, nodes::Text) || has_is(g)) return false;
    bool fixed = scene_.type(g).is_a("X3DGeometryNode");
    for_each_child(scene_, g, [&](NodeId c) { fixed = fixed && scene_.type(c).kind == NodeKind::builtin && !kept_[c.value] && !has_is(c); });
    return fixed;
  }

  std::vector<Part> choose_parts() {
    std::vector<Part> parts;
    std::vector<std::uint32_t> part_of(scene_.node_count(), 0xffffffff);
    for (NodeId n : order_) {
      if (!scene_.is(n, nodes::Shape) || kept_[n.value]) continue;
      const Value* v = scene_.find(n, nodes::shape::geometry.slot);
      if (!v || v->is || !is_fixed_surface(v->node)) continue;
      auto& part = part_of[v->node.value];
      if (part == 0xffffffff) {
        part = static_cast<std::uint32_t>(parts.size());
        parts.push_back({v->node, {}, {}, {}});
      }
      parts[part].shapes.push_back(n);
    }
    return parts;
  }

  /// Reads some of the parts, simplifies them on all threads and stores the results in their order. A batch bounds how many
  /// meshes lie in memory together. Returns its size.
  std::size_t make_batch(std::span<Part> parts) {
    constexpr std::size_t corners_of_batch = 3'000'000;
    std::size_t n = 0, corners = 0;
    for (; n < parts.size() && corners < corners_of_batch; ++n) {
      read(parts[n]);
      corners += parts[n].mesh.corners.size();
    }
    const LevelOptions levels{options_.criterion.value, options_.ratios.values, options_.errors.values, options_.min_saving};
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
      auto& p = parts[i];
      if (static_cast<int>(p.mesh.n_faces()) >= options_.min_faces) p.levels = make_levels(p.mesh, levels);
    });
    for (auto& p : parts.first(n)) {
      if (p.mesh.n_faces() > 0) store(p);
      p = {};
    }
    return n;
  }

  void read(Part& part) {
    if (textured_.empty()) textured_ = textured_geometry(scene_);
    MeshJob job{scene_, part.geometry, part.mesh, scratch_, ctx_, part.geometry.value < textured_.size() && textured_[part.geometry.value] != 0};
    read_mesh(job);
    tessellate(job, {.texcoords = true});
    auto& mesh = part.mesh;
    if (!mesh.is_triangles()) return mesh.clear();
    // What nobody sees must not hold the surface back: texture coordinates without a texture, and the exact normals of
    // shapes whose edges tell the same.
    if (!job.textured) mesh.texcoord.clear();
    if (mesh.primitive) mesh.normal.clear(), mesh.crease_angle = CollapseOptions{}.crease_angle;
  }

  double pixels_per_angle() const { return options_.screen_height / (2 * std::tan(options_.field_of_view / 2)); }

  void store(const Part& part) {
    if (part.levels.empty() && options_.vanish <= 0) {
      ctx_.stats["lod.too-small"] += part.shapes.size();
      return;
    }
    const auto sphere = bounding_sphere(part.mesh);
    std::vector<double> range;
    std::vector<NodeId> geometries;
    for (const auto& level : part.levels) {
      range.push_back(sphere.radius + level.error * pixels_per_angle() / options_.pixels);
      geometries.push_back(scene_.add(nodes::IndexedFaceSet, scene_.where(part.geometry)));
      store_mesh(scene_, geometries.back(), level.mesh);
      ctx_.stats["lod.triangles"] += level.mesh.n_faces();
    }
    if (options_.vanish > 0) range.push_back(2 * sphere.radius * pixels_per_angle() / options_.vanish);
    double least = 0;
    for (auto& r : range) least = r = round_up(std::max(r, least * 1.001));
    for (NodeId shape : part.shapes) make_lod(shape, sphere.center, range, geometries);
  }

  void make_lod(NodeId shape, const Vec3& center, const std::vector<double>& range, const std::vector<NodeId>& geometries) {
    std::vector<NodeId> levels{shape};
    for (NodeId g : geometries) levels.push_back(shape_like(shape, g));
    if (levels.size() < range.size() + 1) levels.push_back(scene_.add(nodes::Group, scene_.where(shape)));
    NodeId n = scene_.add(nodes::LOD, scene_.where(shape));
    scene_.set(n, nodes::lod::children, levels);
    scene_.set(n, nodes::lod::center, center);
    scene_.set(n, nodes::lod::range, range);
    lod_of_[shape.value] = n;
    ++n_lods_;
    ctx_.stats["lod.shapes"] += 1;
    ctx_.stats["lod.levels"] += geometries.size();
  }

  /// The same Shape with another geometry.
  NodeId shape_like(NodeId shape, NodeId geometry) {
    std::vector<Value> fields(scene_.fields(shape).begin(), scene_.fields(shape).end());
    NodeId n = scene_.add(nodes::Shape, scene_.where(shape));
    scene_.set_fields(n, fields);
    scene_.set(n, nodes::shape::geometry, geometry);
    return n;
  }

  void replace(std::vector<NodeId>& list) const {
    for (auto& n : list)
      if (n && lod_of_[n.value]) n = lod_of_[n.value];
  }

  void replace_shapes() {
    replace(scene_.main.roots);
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i) replace(scene_.proto(ProtoId{i}).body.roots);
    for (NodeId n : order_) {
      if (scene_.type(n).kind != NodeKind::builtin || !scene_.type(n).is_a("X3DGroupingNode")) continue;
      for (const Value& v : std::vector<Value>(scene_.fields(n).begin(), scene_.fields(n).end())) {
        if (v.type != FieldType::MFNode || v.is || scene_.is_extra(v)) continue;
        std::vector<NodeId> list(v.node_span().begin(), v.node_span().end());
        replace(list);
        if (!std::ranges::equal(list, v.node_span())) scene_.set(n, scene_.make(FieldType::MFNode, v.slot, list));
      }
    }
  }

  Scene& scene_;
  const LodOptions& options_;
  PassContext& ctx_;
  std::vector<NodeId> order_;      // before anything was added
  std::vector<char> kept_;         // by node
  std::vector<NodeId> lod_of_;     // by Shape
  std::vector<char> textured_;
  MeshScratch scratch_;
  std::size_t n_lods_ = 0;
};

}  // namespace

bool NumberList::read(std::string_view text) {
  values.clear();
  while (!text.empty()) {
    double v;
    auto r = std::from_chars(text.data(), text.data() + text.size(), v);
    if (r.ec != std::errc{} || !std::isfinite(v) || v <= 0) return false;
    values.push_back(v);
    text.remove_prefix(static_cast<std::size_t>(r.ptr - text.data()));
    if (text.empty()) break;
    if (text[0] != ':') return false;
    text.remove_prefix(1);
  }
  return true;
}

std::string NumberList::print() const {
  std::string out;
  for (double v : values) {
    char number[40];
    if (!out.empty()) out += ':';
    out.append(number, std::to_chars(number, number + sizeof number, v).ptr);
  }
  return out;
}

Outcome lod(Scene& scene, const LodOptions& options, PassContext& ctx) { return Lod(scene, options, ctx).run(); }

}  // namespace wrlkit

#include "passes/lightmap/parts.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "base/parallel.h"
#include "base/silent_task.h"
#include "geometry/simplify/surfaces.h"
#include "geometry/unwrap/unfold.h"
#include "passes/lightmap/connected.h"
#include "passes/lightmap/unlit_shapes.h"
#include "passes/lightmap/witnesses.h"
#include "passes/normals/normals.h"
#include "passes/weld/points.h"
#include "scenegraph/driven.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/nodes.h"

namespace wrlkit::bake {
namespace {

using drawing::Affine;
using drawing::Stage;
using drawing::V3;

/// The number of the point of each corner: equal positions are one point.
std::vector<std::uint32_t> points_of(const Mesh& mesh, PointJoiner& joiner) {
  std::vector<std::uint32_t> index = mesh.corners;
  StampedMap map;
  joiner.join_equal(mesh.positions.span(), index, map);
  return index;
}

/// How faces go along the edges of a surface.
enum class Edges : std::uint8_t {
  open,
  balanced,  // each as often in one direction as in the other: outlines may touch themselves
  closed,    // each once in each direction
};

Edges edges_of(const std::vector<std::uint32_t>& corners) {
  std::vector<std::uint64_t> there, back;
  there.reserve(corners.size());
  back.reserve(corners.size());
  for (std::size_t t = 0; t < corners.size(); t += 3)
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t from = corners[t + k], to = corners[t + (k + 1) % 3];
      there.push_back(from << 32 | to);
      back.push_back(to << 32 | from);
    }
  std::ranges::sort(there);
  std::ranges::sort(back);
  if (there != back) return Edges::open;
  return std::ranges::adjacent_find(there) == there.end() ? Edges::closed : Edges::balanced;
}

/// Signed volumes of what a closed surface consists of; 0 for a plate of which both sides lie in one place.
struct Volumes {
  double all = 0;
  bool one_way = true;  // none is wound against another
};

Volumes signed_volumes(const Part& p, const std::vector<std::uint32_t>& points) {
  constexpr double nothing = 1e-9;
  struct Piece {
    double six = 0;
    Box box;
  };
  const auto root = connected(points);
  std::vector<Piece> pieces(root.size());
  Piece all;
  const V3 from = p.position(0);
  for (std::size_t c = 0; c < points.size(); c += 3) {
    const double six = dot(p.position(c) - from, cross(p.position(c + 1) - from, p.position(c + 2) - from));
    Piece& piece = pieces[root[points[c]]];
    for (Piece* to : {&piece, &all}) {
      to->six += six;
      for (std::size_t k = 0; k < 3; ++k) to->box.add(p.position(c + k));
    }
  }
  auto volume = [](const Piece& piece) {
    const double size = drawing::length(piece.box.size());
    return std::fabs(piece.six) > nothing * size * size * size ? piece.six / 6 : 0;
  };
  Volumes out{volume(all), true};
  for (const Piece& piece : pieces)
    if (!piece.box.empty() && volume(piece) * out.all < 0) out.one_way = false;
  return out;
}

/// Appends a triangle's corners in the other order, with all that they have.
class Backs {
 public:
  explicit Backs(Part& part) : part_(part), n_(part.mesh.corners.size()) {}

  void append() {
    Mesh& m = part_.mesh;
    append_turned(m.corners, m.corners);
    for (Attribute* a : m.attributes())
      if (a->present() && a != &m.normal) append_turned(a->index, a->index);
    if (m.normal.present()) append_normals(m.normal);
    part_.normals.resize(2 * 3 * n_);
    for (std::size_t c = 0; c < n_; ++c)
      for (int k = 0; k < 3; ++k) part_.normals[3 * (n_ + c) + k] = -part_.normals[3 * turned(c) + k];
  }

  /// Fronts become backs.
  void turn() {
    Mesh& m = part_.mesh;
    for (Attribute* a : m.attributes())
      if (a->present()) swap(a->index);
    for (float& v : m.normal.values) v = -v;
    swap(m.corners);
    for (std::size_t c = 0; c < n_; c += 3)
      for (int k = 0; k < 3; ++k) std::swap(part_.normals[3 * (c + 1) + k], part_.normals[3 * (c + 2) + k]);
    for (float& v : part_.normals) v = -v;
  }

 private:
  static std::size_t turned(std::size_t corner) {
    return corner % 3 == 1 ? corner + 1 : corner % 3 == 2 ? corner - 1 : corner;
  }

  void append_turned(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>&) const {
    to.resize(2 * n_);
    for (std::size_t c = 0; c < n_; ++c) to[n_ + c] = to[turned(c)];
  }
  void append_normals(Attribute& a) const {
    const auto n_values = static_cast<std::uint32_t>(a.count());
    for (std::uint32_t i = 0; i < 3 * n_values; ++i) a.values.push_back(-a.values[i]);
    a.index.resize(2 * n_);
    for (std::size_t c = 0; c < n_; ++c) a.index[n_ + c] = a.index[turned(c)] + n_values;
  }
  void swap(std::vector<std::uint32_t>& index) const {
    for (std::size_t c = 0; c < n_; c += 3) std::swap(index[c + 1], index[c + 2]);
  }

  Part& part_;
  std::size_t n_;
};

class Finder {
 public:
  Finder(const Scene& scene, const light::LightWorld& world, const UnlitShapes& unlit, const Tessellation& faces,
         PassContext& ctx)
      : scene_(scene),
        world_(world),
        unlit_(unlit),
        stage_(world.stage()),
        witnesses_(scene, world),
        silent_(ctx),
        reader_(scene, silent_, faces) {
    const auto driven = driven_geometry(scene);  // a Script may write what it likes
    for (const auto& s : surfaces_of(scene, {}, BelowLod::take, OfText::take))
      if (!scene.is(s.geometry, nodes::Text) || !driven[s.geometry.value]) lit_.emplace(s.geometry.value, s);
  }

  std::vector<Part> run() {
    std::unordered_map<std::uint32_t, std::size_t> number;
    std::vector<Part> parts;
    std::unordered_set<std::uint32_t> shapes;
    for (std::uint32_t u = 0; u < stage_.uses.size(); ++u) {
      const auto& use = stage_.uses[u];
      if (!lit_.contains(use.geometry.value) || !takes_light(use)) continue;
      auto [at, added] = number.try_emplace(use.geometry.value, parts.size());
      if (added) parts.push_back({.geometry = use.geometry, .letters = scene_.is(use.geometry, nodes::Text)});
      if (finite(stage_.frames[use.frame]) && shapes.insert(use.shape.value).second)
        parts[at->second].uses.push_back(u);
    }
    for (Part& p : parts) read(p);
    std::erase_if(parts, [](const Part& p) { return p.uses.empty() || p.mesh.corners.empty(); });
    return parts;
  }

 private:
  bool takes_light(const drawing::Use& use) const {
    const auto m = material_of(scene_, use.appearance);
    return m ? m->kind != MaterialNode::Kind::unlit : unlit_.are_lit() && unlit_.is_one(use.shape, use.appearance);
  }

  void read(Part& p) {
    reader_.read(lit_.at(p.geometry.value), p.mesh);
    if (p.mesh.corners.empty()) return;
    resolve_order(p.mesh);
    add_normals(p);
    p.n_fronts = p.n_triangles();
    PointJoiner joiner;
    const auto points = points_of(p.mesh, joiner);
    const Edges edges = edges_of(points);
    const bool was_solid = p.mesh.solid;
    const Volumes volumes =
        edges == Edges::closed || (edges == Edges::balanced && was_solid) ? signed_volumes(p, points) : Volumes();
    p.mesh.solid = true;
    if (edges == Edges::balanced && volumes.all > 0) return;
    const bool outward = was_solid && volumes.all > 0;
    p.sealed = outward ||
               (volumes.all != 0 && volumes.one_way && !is_clear(p) && !has_witness(p) && !(was_solid && is_room(p)));
    if (!p.sealed) return was_solid ? void() : Backs(p).append();
    p.inside_out = volumes.all < 0;
    if (!p.inside_out) return;
    Backs(p).turn();
    p.faces_in = was_solid;
  }

  bool is_clear(const Part& p) const {
    return std::ranges::any_of(p.uses, [&](std::uint32_t u) { return world_.is_clear(u); });
  }

  bool has_witness(const Part& p) const {
    return std::ranges::any_of(p.uses, [&](std::uint32_t u) { return witnesses_.within(box_of(p, u), u); });
  }

  /// Something is in it, or it shines itself.
  bool is_room(const Part& p) const {
    return std::ranges::any_of(
        p.uses, [&](std::uint32_t u) { return world_.emitter_of(u, 0) || witnesses_.holds_another(box_of(p, u), u); });
  }

  Box box_of(const Part& p, std::uint32_t use) const {
    Box box;
    for (std::size_t c = 0; c < p.mesh.corners.size(); ++c)
      box.add(stage_.frames[stage_.uses[use].frame].point(p.position(c)));
    return box;
  }

  /// `ccw` FALSE: corners and all that they have turn round, so that the front is where they run counter-clockwise.
  static void resolve_order(Mesh& m) {
    if (m.ccw) return;
    m.ccw = true;
    auto turn = [](std::vector<std::uint32_t>& index) {
      for (std::size_t c = 0; c + 2 < index.size(); c += 3) std::swap(index[c + 1], index[c + 2]);
    };
    turn(m.corners);
    for (Attribute* a : m.attributes())
      if (a->present()) turn(a->index);
  }

  void add_normals(Part& p) {
    shaded_ = p.mesh;
    MeshJob job{scene_, p.geometry, shaded_, scratch_, silent_};
    normals(job, {});
    p.normals.resize(3 * p.mesh.corners.size());
    for (std::size_t c = 0; c < p.mesh.corners.size(); ++c) {
      const float* n = shaded_.normal.present() ? shaded_.normal.at(shaded_.normal.index[c]) : nullptr;
      const V3 u = n ? unit(V3(n[0], n[1], n[2])) : V3();
      p.normals[3 * c] = static_cast<float>(u.x);
      p.normals[3 * c + 1] = static_cast<float>(u.y);
      p.normals[3 * c + 2] = static_cast<float>(u.z);
    }
  }

  const Scene& scene_;
  const light::LightWorld& world_;
  const UnlitShapes& unlit_;
  const Stage& stage_;
  Witnesses witnesses_;
  SilentTask silent_;
  SurfaceReader reader_;
  std::unordered_map<std::uint32_t, ShapeSurface> lit_;
  Mesh shaded_;
  MeshScratch scratch_;
};

/// As one sees them from the front, and their backs from behind.
unwrap::Charts charts_of_letters(const Part& p, const Affine& frame) {
  const V3 x = unit(frame.vector({1, 0, 0})), y = cross(unit(frame.normal({0, 0, 1})), x),
           origin = frame.point({0, 0, 0});
  const auto n = static_cast<std::uint32_t>(p.n_triangles()), n_fronts = static_cast<std::uint32_t>(p.n_fronts);
  unwrap::Charts charts;
  for (const auto& [first, last, way] : {std::tuple{0u, n_fronts, 1.0}, std::tuple{n_fronts, n, -1.0}}) {
    if (first == last) continue;
    Box box;
    const auto begin = charts.places.size();
    std::vector<V3> places;
    for (std::size_t c = 3 * std::size_t{first}; c < 3 * std::size_t{last}; ++c) {
      const V3 at = frame.point(p.position(c)) - origin;
      places.push_back({way * dot(at, x), dot(at, y), 0});
      box.add(places.back());
    }
    for (const V3& v : places)
      charts.places.push_back({static_cast<float>(v.x - box.low[0]), static_cast<float>(v.y - box.low[1])});
    charts.chart_of.resize(charts.places.size() / 3, static_cast<std::uint32_t>(charts.sizes.size()));
    charts.begin.push_back(static_cast<std::uint32_t>(begin / 3));
    charts.sizes.push_back({static_cast<float>(box.size(0)), static_cast<float>(box.size(1))});
  }
  charts.begin.push_back(n);
  charts.triangles.resize(n);
  std::iota(charts.triangles.begin(), charts.triangles.end(), 0u);
  return charts;
}

void unfold(Part& p, const Stage& stage) {
  const Affine& frame = stage.frames[stage.uses[p.uses[0]].frame];
  if (p.letters) {
    p.charts = charts_of_letters(p, frame);
    return;
  }
  PointJoiner joiner;
  auto corners = points_of(p.mesh, joiner);
  std::vector<double> world(joiner.points.size());
  for (std::size_t i = 0; i + 2 < world.size(); i += 3) {
    const V3 v = frame.vector({joiner.points[i], joiner.points[i + 1], joiner.points[i + 2]});
    world[i] = v.x;
    world[i + 1] = v.y;
    world[i + 2] = v.z;
  }
  // A frame that mirrors shows the front of a face where its corners run clockwise.
  if (frame.determinant() < 0)
    for (std::size_t c = 0; c < corners.size(); c += 3) std::swap(corners[c + 1], corners[c + 2]);
  // Backs lie on the points of their fronts and would be taken for neighbours: they get points of their own.
  if (p.n_fronts < p.n_triangles()) {
    const auto n_points = static_cast<std::uint32_t>(world.size() / 3);
    world.insert(world.end(), world.begin(), world.begin() + 3 * std::ptrdiff_t{n_points});
    for (std::size_t c = 3 * p.n_fronts; c < corners.size(); ++c) corners[c] += n_points;
  }
  p.charts = unwrap::unfold({world, corners, {}});
  if (frame.determinant() < 0)
    for (std::size_t c = 0; c < corners.size(); c += 3) std::swap(p.charts.places[c + 1], p.charts.places[c + 2]);
}

}  // namespace

std::vector<Part> find_parts(const Scene& scene, const light::LightWorld& world, const UnlitShapes& unlit,
                             const Tessellation& faces, PassContext& ctx) {
  return Finder(scene, world, unlit, faces, ctx).run();
}

void face_in(Part& part, std::vector<float>& coords) {
  if (!part.faces_in) return;
  Backs(part).turn();
  for (std::size_t c = 0; c + 5 < coords.size(); c += 6)
    std::swap_ranges(&coords[c + 2], &coords[c + 4], &coords[c + 4]);
}

void unfold_parts(std::vector<Part>& parts, const Stage& stage) {
  parallel_for(parts.size(), [&](std::size_t i) { unfold(parts[i], stage); });
}

}  // namespace wrlkit::bake

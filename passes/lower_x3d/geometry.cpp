#include "passes/lower_x3d/geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

constexpr int sides = 64;  // of a circle

using Indices = std::vector<std::int32_t>;

// ---- sets of triangles, quadrilaterals and lines
// ----------------------------------------------------------------------

enum class Cut { polygons3, polygons4, fans, strips, lines };

struct SetRow {
  TypeId type;
  Cut cut;
  bool indexed;
  std::uint16_t list;  // slot of the indices, or of the lengths of fans, strips and lines
  bool has_list = true;
};

constexpr SetRow sets[] = {
    {nodes::IndexedTriangleSet, Cut::polygons3, true, nodes::indexed_triangle_set::index.slot},
    {nodes::IndexedTriangleFanSet, Cut::fans, true, nodes::indexed_triangle_fan_set::index.slot},
    {nodes::IndexedTriangleStripSet, Cut::strips, true, nodes::indexed_triangle_strip_set::index.slot},
    {nodes::IndexedQuadSet, Cut::polygons4, true, nodes::indexed_quad_set::index.slot},
    {nodes::TriangleSet, Cut::polygons3, false, 0, false},
    {nodes::TriangleFanSet, Cut::fans, false, nodes::triangle_fan_set::fanCount.slot},
    {nodes::TriangleStripSet, Cut::strips, false, nodes::triangle_strip_set::stripCount.slot},
    {nodes::QuadSet, Cut::polygons4, false, 0, false},
    {nodes::LineSet, Cut::lines, false, nodes::line_set::vertexCount.slot},
};

NodeId child_of(const Scene& scene, NodeId n, std::string_view field) {
  auto slot = scene.type(n).find(field, Dialect::x3d);
  return slot && !scene.value(n, *slot).is ? scene.value(n, *slot).node : NodeId{};
}

std::size_t n_points(const Scene& scene, NodeId n) {
  NodeId coord = child_of(scene, n, "coord");
  return scene.is(coord, nodes::Coordinate) ? scene.get(coord, nodes::coordinate::point).size() / 3 : 0;
}

/// What is cut: the runs of an index list, or consecutive points.
std::vector<Indices> runs_of(const Scene& scene, NodeId n, const SetRow& row) {
  const std::int32_t points = static_cast<std::int32_t>(std::min<std::size_t>(n_points(scene, n), INT32_MAX));
  const auto list = row.has_list ? scene.value(n, row.list).integer_span() : std::span<const std::int32_t>{};
  std::vector<Indices> runs(1);
  if (row.indexed) {
    for (auto i : list) {
      if (i >= 0)
        runs.back().push_back(i);
      else if (row.cut == Cut::fans || row.cut == Cut::strips)
        runs.emplace_back();
    }
  } else if (row.has_list) {
    std::int32_t at = 0;
    for (auto length : list) {
      runs.emplace_back(static_cast<std::size_t>(std::clamp(length, 0, points - at)));
      std::iota(runs.back().begin(), runs.back().end(), at);
      at += static_cast<std::int32_t>(runs.back().size());
    }
  } else {
    runs.back().resize(static_cast<std::size_t>(points));
    std::iota(runs.back().begin(), runs.back().end(), 0);
  }
  return runs;
}

void cut_polygons(const Indices& run, std::size_t corners, Indices& out) {
  for (std::size_t i = 0; i + corners <= run.size(); i += corners) {
    out.insert(out.end(), run.begin() + static_cast<std::ptrdiff_t>(i),
               run.begin() + static_cast<std::ptrdiff_t>(i + corners));
    out.push_back(-1);
  }
}

void cut(const Indices& run, Cut how, Indices& out) {
  switch (how) {
    case Cut::polygons3:
      return cut_polygons(run, 3, out);
    case Cut::polygons4:
      return cut_polygons(run, 4, out);
    case Cut::lines:
      return cut_polygons(run, std::max<std::size_t>(run.size(), 1), out);
    case Cut::fans:
      for (std::size_t i = 1; i + 1 < run.size(); ++i) out.insert(out.end(), {run[0], run[i], run[i + 1], -1});
      return;
    case Cut::strips:  // every other triangle is turned round
      for (std::size_t i = 0; i + 2 < run.size(); ++i)
        out.insert(out.end(), {run[i + i % 2], run[i + 1 - i % 2], run[i + 2], -1});
  }
}

void lower_set(Scene& scene, NodeId n, const SetRow& row) {
  namespace ifs = nodes::indexed_face_set;
  Indices index;
  for (const auto& run : runs_of(scene, n, row)) cut(run, row.cut, index);
  const bool lines = row.cut == Cut::lines;
  auto fields = fields_for(scene, n, lines ? nodes::IndexedLineSet : nodes::IndexedFaceSet);
  const auto slot = lines ? nodes::indexed_line_set::coordIndex.slot : ifs::coordIndex.slot;
  fields.push_back(scene.make(FieldType::MFInt32, slot, index));
  if (!lines) {
    // Without normals the points that faces share are smooth (19775-1, 11.2.3).
    auto per_vertex = scene.type(n).find("normalPerVertex", Dialect::x3d);
    if (per_vertex && scene.value(n, *per_vertex).integer && !child_of(scene, n, "normal"))
      fields.push_back(scene.make(FieldType::SFFloat, ifs::creaseAngle.slot, std::numbers::pi));
  }
  scene.become(n, lines ? nodes::IndexedLineSet : nodes::IndexedFaceSet, fields);
}

// ---- the plane
// --------------------------------------------------------------------------------------------------------

struct Flat {
  std::vector<double> points, texcoords;  // xyz, st
  Indices index;
  bool solid = false;

  void add(double x, double y) { points.insert(points.end(), {x, y, 0}); }
  /// A face or line over all points so far.
  void close(bool loop = false) {
    index.resize(points.size() / 3);
    std::iota(index.begin(), index.end(), 0);
    if (loop && !index.empty()) index.push_back(0);
    index.push_back(-1);
  }
  /// The picture covers a square of that half edge, or a rectangle.
  void map(double half_width, double half_height) {
    for (std::size_t i = 0; i < points.size(); i += 3)
      texcoords.insert(texcoords.end(), {points[i] / (2 * half_width) + 0.5, points[i + 1] / (2 * half_height) + 0.5});
  }
};

/// Points of an arc; equal ends are a whole circle, whose last point is not given again. True: it is whole.
bool arc(Flat& f, double radius, double start, double end) {
  constexpr double turn = 2 * std::numbers::pi;
  if (!std::isfinite(start) || !std::isfinite(end)) start = end = 0;
  double sweep = std::fmod(end - start, turn);
  if (sweep < 0) sweep += turn;
  const bool whole = sweep < 1e-9 || turn - sweep < 1e-9;
  const int n = whole ? sides : std::max(1, static_cast<int>(std::ceil(sides * sweep / turn)));
  for (int i = 0; i < n + !whole; ++i) {
    double a = start + (whole ? turn : sweep) * i / n;
    f.add(radius * std::cos(a), radius * std::sin(a));
  }
  return whole;
}

void ring(Flat& f, double inner, double outer) {
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * std::numbers::pi * i / sides, c = std::cos(a), s = std::sin(a);
    f.add(outer * c, outer * s);
    f.add(inner * c, inner * s);
    const std::int32_t k = 2 * i, next = 2 * ((i + 1) % sides);
    f.index.insert(f.index.end(), {k, next, next + 1, k + 1, -1});
  }
}

NodeId coordinate(Scene& scene, NodeId n, const Flat& f) {
  NodeId c = scene.add(nodes::Coordinate, scene.where(n));
  scene.set(c, nodes::coordinate::point, f.points);
  return c;
}

void become_faces(Scene& scene, NodeId n, const Flat& f) {
  namespace ifs = nodes::indexed_face_set;
  auto fields = fields_for(scene, n, nodes::IndexedFaceSet);
  fields.push_back(scene.make(FieldType::SFNode, ifs::coord.slot, coordinate(scene, n, f)));
  fields.push_back(scene.make(FieldType::MFInt32, ifs::coordIndex.slot, f.index));
  if (!scene.find(n, *scene.type(n).find("solid", Dialect::x3d)))
    fields.push_back(scene.make(FieldType::SFBool, ifs::solid.slot, f.solid));
  fields.push_back(scene.make(FieldType::SFBool, ifs::convex.slot, false));
  if (!f.texcoords.empty()) {
    NodeId t = scene.add(nodes::TextureCoordinate, scene.where(n));
    scene.set(t, nodes::texture_coordinate::point, f.texcoords);
    fields.push_back(scene.make(FieldType::SFNode, ifs::texCoord.slot, t));
  }
  scene.become(n, nodes::IndexedFaceSet, fields);
}

void become_lines(Scene& scene, NodeId n, const Flat& f) {
  namespace ils = nodes::indexed_line_set;
  auto fields = fields_for(scene, n, nodes::IndexedLineSet);
  fields.push_back(scene.make(FieldType::SFNode, ils::coord.slot, coordinate(scene, n, f)));
  fields.push_back(scene.make(FieldType::MFInt32, ils::coordIndex.slot, f.index));
  scene.become(n, nodes::IndexedLineSet, fields);
}

void add_all(Flat& f, std::span<const double> xy) {
  for (std::size_t i = 0; i + 1 < xy.size(); i += 2) f.add(xy[i], xy[i + 1]);
}

bool lower_flat_lines(Scene& scene, NodeId n) {
  Flat f;
  if (scene.is(n, nodes::Arc2D)) {
    namespace a = nodes::arc2d;
    f.close(arc(f, scene.get(n, a::radius), scene.get(n, a::startAngle), scene.get(n, a::endAngle)));
  } else if (scene.is(n, nodes::Circle2D)) {
    f.close(arc(f, scene.get(n, nodes::circle2d::radius), 0, 0));
  } else if (scene.is(n, nodes::Polyline2D)) {
    add_all(f, scene.get(n, nodes::polyline2d::lineSegments));
    f.close();
  } else {
    return false;
  }
  become_lines(scene, n, f);
  return true;
}

void disk(Scene& scene, NodeId n) {
  namespace d = nodes::disk2d;
  Flat f;
  const double inner = scene.get(n, d::innerRadius), outer = scene.get(n, d::outerRadius);
  if (inner == outer) {
    f.close(arc(f, outer, 0, 0));
    return become_lines(scene, n, f);
  }
  if (inner > 0)
    ring(f, inner, outer);
  else {
    arc(f, outer, 0, 0);
    f.close();
  }
  f.map(outer, outer);
  become_faces(scene, n, f);
}

bool lower_flat_faces(Scene& scene, NodeId n) {
  Flat f;
  if (scene.is(n, nodes::Disk2D)) {
    disk(scene, n);
    return true;
  }
  if (scene.is(n, nodes::ArcClose2D)) {
    namespace a = nodes::arc_close2d;
    const double radius = scene.get(n, a::radius);
    const bool whole = arc(f, radius, scene.get(n, a::startAngle), scene.get(n, a::endAngle));
    if (!whole && scene.get(n, a::closureType) != "CHORD") f.add(0, 0);
    f.close();
    f.map(radius, radius);
  } else if (scene.is(n, nodes::Rectangle2D)) {
    const auto size = scene.get(n, nodes::rectangle2d::size);
    const double x = size[0] / 2, y = size[1] / 2;
    f.add(-x, -y);
    f.add(x, -y);
    f.add(x, y);
    f.add(-x, y);
    f.close();
    f.map(x, y);
  } else if (scene.is(n, nodes::TriangleSet2D)) {
    add_all(f, scene.get(n, nodes::triangle_set2d::vertices));
    Indices run(f.points.size() / 3);
    std::iota(run.begin(), run.end(), 0);
    cut_polygons(run, 3, f.index);
  } else {
    return false;
  }
  become_faces(scene, n, f);
  return true;
}

bool lower_flat_points(Scene& scene, NodeId n) {
  if (!scene.is(n, nodes::Polypoint2D)) return false;
  Flat f;
  add_all(f, scene.get(n, nodes::polypoint2d::point));
  auto fields = fields_for(scene, n, nodes::PointSet);
  fields.push_back(scene.make(FieldType::SFNode, nodes::point_set::coord.slot, coordinate(scene, n, f)));
  scene.become(n, nodes::PointSet, fields);
  return true;
}

}  // namespace

std::vector<Value> fields_for(const Scene& scene, NodeId n, TypeId type) {
  std::vector<Value> out;
  const auto& target = scene.type(type);
  for (Value v : scene.fields(n)) {
    if (scene.is_extra(v)) {
      if (target.find(v.extra->name, Dialect::x3d)) continue;  // what meant nothing may not begin to mean something
    } else {
      auto slot = target.find(scene.type(n).fields[v.slot].name, Dialect::x3d);
      if (!slot || target.fields[*slot].type != v.type) continue;
      v.slot = *slot;
    }
    out.push_back(v);
  }
  return out;
}

bool lower_geometry(Scene& scene, NodeId n) {
  auto row = std::ranges::find(sets, scene.type_id(n), &SetRow::type);
  if (row != std::end(sets)) {
    lower_set(scene, n, *row);
    return true;
  }
  if (!scene.is(n, nodes::X3DGeometryNode)) return false;
  return lower_flat_lines(scene, n) || lower_flat_faces(scene, n) || lower_flat_points(scene, n);
}

}  // namespace wrlkit::x3d

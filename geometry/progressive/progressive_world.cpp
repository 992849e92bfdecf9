#include "geometry/progressive/progressive_world.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "geometry/progressive/bytes.h"
#include "geometry/simplify/surfaces.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"

namespace wrlkit {
namespace {

using namespace simplify;

constexpr std::string_view magic = "WPW1";

struct Placed {
  NodeId geometry;
  std::vector<ProgressivePlace> places;
};

std::array<std::uint8_t, 4> color_of(const Scene& scene, NodeId shape) {
  const auto m = material_of(scene, scene.get(shape, nodes::shape::appearance));
  if (!m) return {255, 255, 255, 255};
  auto byte = [](double x) { return static_cast<std::uint8_t>(x > 0 ? std::lround(255 * std::min(x, 1.)) : 0); };
  const Vec3 &c = m->color, e = m->kind == MaterialNode::Kind::unlit ? Vec3{0, 0, 0} : m->emissive;
  return {byte(c[0] + e[0]), byte(c[1] + e[1]), byte(c[2] + e[2]), byte(1 - m->transparency)};
}

/// The geometries of the Shapes that are shown, in the order in which they are met first.
std::vector<Placed> places_of(const Scene& scene, Diagnostics& diag) {
  std::vector<Placed> out;
  std::vector<std::uint32_t> number(scene.node_count());  // of each geometry, from 1
  const bool complete = for_each_place(scene, Shown::now, [&](NodeId n, const Matrix& matrix) {
    const NodeId geometry = scene.get(n, nodes::shape::geometry);
    if (!geometry) return;
    auto& i = number[geometry.value];
    if (i == 0) {
      out.push_back({geometry, {}});
      i = static_cast<std::uint32_t>(out.size());
    }
    out[i - 1].places.push_back({std::string(scene.name(n)), matrix, color_of(scene, n)});
  });
  if (!complete) diag.report(Diag::expansion_limit, {}, most_visits, "nodes when every USE is followed");
  return out;
}

double largest_scale(const ProgressiveSurface& surface) {
  double scale = 0;
  for (const auto& p : surface.places) scale = std::max(scale, scale_of(p.matrix));
  return scale;
}

struct Piece {
  std::uint32_t surface;
  std::size_t begin, end;
  double error;  // before it has come
};

std::vector<Piece> pieces_of(std::span<const ProgressiveSurface> surfaces) {
  std::vector<Piece> out;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const double scale = largest_scale(surfaces[i]);
    Piece piece{i, 0, 0, HUGE_VAL};
    for (const auto& cut : surfaces[i].stream.cuts) {
      piece.end = cut.end;
      out.push_back(piece);
      piece.begin = cut.end;
      piece.error = cut.error * scale;
    }
  }
  std::ranges::stable_sort(out, std::greater{}, &Piece::error);
  return out;
}

/// False when it is none, or the bytes end.
bool read_place(ByteReader& in, ProgressivePlace& place) {
  place.name = in.bytes(in.number());
  for (double& x : place.matrix.m) x = in.fixed<double>();
  for (auto& b : place.color) b = in.byte();
  return !in.ended() && std::ranges::all_of(place.matrix.m, [](double x) { return std::isfinite(x); });
}

}  // namespace

std::vector<ProgressiveSurface> progressive_surfaces(const Scene& scene, Criterion criterion, Task& ctx) {
  std::vector<ProgressiveSurface> out;
  std::vector<Mesh> meshes;
  SurfaceReader reader(scene, ctx);
  std::size_t n_lit = 0;
  for (auto& placed : places_of(scene, ctx.diag)) {
    Mesh mesh;
    reader.read({placed.geometry, {}}, mesh);
    if (mesh.n_faces() == 0) continue;
    n_lit += mesh.lightcoord.present();
    mesh.lightcoord.clear();
    meshes.push_back(std::move(mesh));
    out.push_back({std::move(placed.places), {}});
  }
  if (n_lit) ctx.diag.report(Diag::no_progressive_light, {}, n_lit);
  parallel_for(meshes.size(), [&](std::size_t i) {
    if (const auto record = make_progressive(meshes[i], criterion)) out[i].stream = write_progressive(*record);
  });
  return out;
}

std::string write_progressive_world(std::span<const ProgressiveSurface> surfaces) {
  std::string bytes;
  ByteWriter out(bytes);
  out.bytes(magic);
  out.number(surfaces.size());
  for (const auto& s : surfaces) {
    out.number(s.places.size());
    for (const auto& p : s.places) {
      out.number(p.name.size());
      out.bytes(p.name);
      for (double x : p.matrix.m) out.fixed(x);
      for (std::uint8_t b : p.color) out.byte(b);
    }
  }
  for (const auto& piece : pieces_of(surfaces)) {
    out.number(piece.surface);
    out.number(piece.end - piece.begin);
    out.bytes(std::string_view(surfaces[piece.surface].stream.bytes).substr(piece.begin, piece.end - piece.begin));
  }
  return bytes;
}

ProgressiveWorldRead read_progressive_world(std::string_view bytes) {
  ProgressiveWorldRead out;
  ByteReader in(bytes);
  auto fault = [&](const char* what) { return ProgressiveWorldRead{{}, what}; };
  if (in.bytes(magic.size()) != magic) return fault("not a progressive world, or of another version");
  for (std::uint64_t n = in.number(); n > 0; --n) {
    auto& surface = out.surfaces.emplace_back();
    for (std::uint64_t k = in.number(); k > 0; --k)
      if (!read_place(in, surface.places.emplace_back())) return fault("the places of the surfaces cannot be read");
    if (in.ended()) return fault("the places of the surfaces cannot be read");
  }
  while (in.left() > 0) {
    const std::uint64_t i = in.number(), n = in.number();
    if (in.ended()) break;
    if (i >= out.surfaces.size()) return fault("a piece is of no surface");
    out.surfaces[i].stream.bytes += in.bytes(std::min<std::uint64_t>(n, in.left()));
  }
  return out;
}

}  // namespace wrlkit

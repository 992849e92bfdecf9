#include "geometry/simplify/world_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "geometry/geometry.h"
#include "geometry/simplify/allocation.h"
#include "geometry/simplify/inverse.h"
#include "geometry/simplify/shared_borders.h"
#include "geometry/simplify/surface.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"

namespace wrlkit {
namespace {

using simplify::AllocatedPart;
using simplify::Rung;
using simplify::SurfaceSample;

constexpr std::size_t most_places_asked = 4;    // of a part, for what is near
constexpr std::size_t samples_of_leaving = 32;  // of a part in a place
constexpr double least_neighbour = 0.25;        // area of another part that may stand for a piece, by that of the part

/// Triangles of each connected piece of a surface.
std::vector<std::vector<std::uint32_t>> components(const Mesh& mesh) {
  std::vector<std::uint32_t> root(mesh.n_positions());
  std::iota(root.begin(), root.end(), 0u);
  auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3)
    for (std::size_t k = 1; k < 3; ++k) root[find(mesh.corners[i + k])] = find(mesh.corners[i]);
  std::vector<std::uint32_t> number(mesh.n_positions(), simplify::none);
  std::vector<std::vector<std::uint32_t>> out;
  for (std::uint32_t f = 0; f < mesh.n_faces(); ++f) {
    auto& n = number[find(mesh.corners[std::size_t{3} * f])];
    if (n == simplify::none) {
      n = static_cast<std::uint32_t>(out.size());
      out.emplace_back();
    }
    out[n].push_back(f);
  }
  return out;
}

/// Some faces of a mesh, with what they use.
Mesh piece_of(const Mesh& mesh, std::span<const std::uint32_t> faces, std::vector<std::uint32_t>& original) {
  Mesh out;
  out.kind = Mesh::Kind::faces;
  out.ccw = mesh.ccw;
  out.solid = mesh.solid;
  out.crease_angle = mesh.crease_angle;
  original.clear();
  for (auto f : faces)
    for (std::size_t k = 0; k < 3; ++k) original.push_back(mesh.corners[std::size_t{3} * f + k]);
  std::ranges::sort(original);
  original.erase(std::unique(original.begin(), original.end()), original.end());
  auto& positions = out.positions.edit();
  for (auto p : original)
    positions.insert(positions.end(), mesh.positions.data() + std::size_t{3} * p,
                     mesh.positions.data() + std::size_t{3} * p + 3);
  const auto from = mesh.attributes();
  const auto to = out.attributes();
  for (auto f : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto c = std::size_t{3} * f + k;
      out.corners.push_back(
          static_cast<std::uint32_t>(std::ranges::lower_bound(original, mesh.corners[c]) - original.begin()));
      for (std::size_t a = 0; a < from.size(); ++a) {
        if (!from[a]->present()) continue;
        to[a]->width = from[a]->width;
        to[a]->index.push_back(static_cast<std::uint32_t>(to[a]->count()));
        const float* v = from[a]->at(from[a]->index[c]);
        to[a]->values.insert(to[a]->values.end(), v, v + from[a]->width);
      }
    }
  return out;
}

/// Appends a mesh to another one; attributes that one of them lacks are dropped.
void append(Mesh& to, const Mesh& from) {
  const auto base = static_cast<std::uint32_t>(to.n_positions());
  const bool first = to.corners.empty();
  auto& positions = to.positions.edit();
  positions.insert(positions.end(), from.positions.data(), from.positions.data() + from.positions.size());
  for (auto c : from.corners) to.corners.push_back(base + c);
  const auto a = to.attributes();
  const auto b = from.attributes();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!b[i]->present() || (!first && !a[i]->present())) {
      a[i]->clear();
      continue;
    }
    const auto begin = static_cast<std::uint32_t>(a[i]->count());
    a[i]->width = b[i]->width;
    a[i]->values.insert(a[i]->values.end(), b[i]->values.begin(), b[i]->values.end());
    for (auto index : b[i]->index) a[i]->index.push_back(begin + index);
  }
}

}  // namespace

struct WorldLevels::Impl {
  struct WorldSurface {
    ShapeSurface surface;
    Mesh mesh;
    std::vector<Matrix> places;
    std::size_t widest = 0;  // of the places
    std::vector<std::uint32_t> fixed;
    std::uint32_t first_part = 0, n_parts = 0;
  };
  struct Piece {
    std::uint32_t surface;
    std::vector<std::uint32_t> faces;
    double area = 0;  // in a place
  };

  Impl(const Scene& s, const WorldSimplifyOptions& o) : scene(s), options(o) {}

  const Scene& scene;
  WorldSimplifyOptions options;
  std::vector<WorldSurface> surfaces;
  std::vector<Piece> pieces;
  std::vector<AllocatedPart> parts;  // of each piece
  simplify::Neighbours neighbours;
  std::vector<std::uint32_t> piece_of_owner;
  double area = 0;
  std::size_t n_drawn = 0, n_faces = 0;
  std::vector<Point> points;
  std::vector<std::vector<std::uint32_t>> rungs;  // by point, of each part

  void read(Task& ctx);
  void cut();
  void make_part(std::size_t i);
  void look_around(std::size_t i, const Matrix& frame, std::vector<SurfaceSample>& samples) const;
  void allocate();
  Mesh mesh_at(const WorldSurface& s, const std::vector<std::uint32_t>& at) const;
  bool is_changed(const WorldSurface& s, const std::vector<std::uint32_t>& at) const;
};

void WorldLevels::Impl::read(Task& ctx) {
  SurfaceReader reader(scene, ctx);
  const auto found = surfaces_of(scene, &ctx.diag);
  SharedBorders borders;
  Mesh mesh;
  for (const auto& s : found) {
    reader.read(s, mesh);
    borders.add(mesh);
    surfaces.push_back({s, std::move(mesh), {}, 0, {}, 0, 0});
  }
  auto fixed = borders.find(scene, found);
  for (std::size_t i = 0; i < surfaces.size(); ++i) surfaces[i].fixed = std::move(fixed[i]);
  const auto number = surface_numbers(scene, found);
  for_each_place(scene, Shown::now, [&](NodeId shape, const Matrix& m) {
    if (const auto i = number[shape.value]; i && simplify::is_invertible(m)) surfaces[i - 1].places.push_back(m);
  });
  std::erase_if(surfaces, [](const WorldSurface& s) { return s.mesh.n_faces() == 0 || s.places.empty(); });
  for (auto& s : surfaces) {
    n_faces += s.mesh.n_faces();
    n_drawn += s.mesh.n_faces() * s.places.size();
    for (std::size_t i = 1; i < s.places.size(); ++i)
      if (scale_of(s.places[i]) > scale_of(s.places[s.widest])) s.widest = i;
  }
}

/// Surfaces into pieces, each of which knows what it is in the world.
void WorldLevels::Impl::cut() {
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    auto& s = surfaces[i];
    s.first_part = static_cast<std::uint32_t>(pieces.size());
    for (auto& faces : components(s.mesh)) pieces.push_back({i, std::move(faces), 0});
    s.n_parts = static_cast<std::uint32_t>(pieces.size()) - s.first_part;
  }
  parts.resize(pieces.size());
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const auto& s = surfaces[pieces[i].surface];
    const double widest = scale_of(s.places[s.widest]);
    parts[i].weight = 0;
    for (const Matrix& m : s.places) {
      const auto owner = static_cast<std::uint32_t>(piece_of_owner.size());
      parts[i].places.push_back(owner);
      parts[i].weight += std::pow(scale_of(m) / widest, 4);
      neighbours.add(triangles_of(s.mesh), pieces[i].faces, m, owner);
      piece_of_owner.push_back(i);
    }
  }
  neighbours.prepare();
}

/// How far from each sample something else is, of which it may be thought that it stays.
void WorldLevels::Impl::look_around(std::size_t i, const Matrix& frame, std::vector<SurfaceSample>& samples) const {
  const auto& s = surfaces[pieces[i].surface];
  const Matrix back = simplify::inverse(frame);
  const std::size_t stride = (s.places.size() + most_places_asked - 1) / most_places_asked;
  for (auto& sample : samples) sample.enough = 0;
  double reach = 0;
  for (const auto& sample : samples)
    for (double x : sample.point) reach = std::max(reach, std::abs(x));
  for (std::size_t k = 0; k < s.places.size(); k += stride) {
    const Matrix place = s.places[k] * back;
    const auto own = parts[i].places[k];
    for (auto& sample : samples) {
      const double d = neighbours
                           .nearest(place.point(sample.point), reach,
                                    [&](std::uint32_t owner) {
                                      return owner != own && pieces[piece_of_owner[owner]].area >=
                                                                 least_neighbour * pieces[i].area;
                                    })
                           .distance;
      sample.enough = std::max(sample.enough, d * d);
    }
  }
}

void WorldLevels::Impl::make_part(std::size_t i) {
  const auto& s = surfaces[pieces[i].surface];
  std::vector<std::uint32_t> original;
  const Mesh mesh = piece_of(s.mesh, pieces[i].faces, original);
  Matrix frame = s.places[s.widest];
  const Vec3 origin = frame.point(triangles_of(mesh).position(0));
  for (int r = 0; r < 3; ++r) frame(r, 3) -= origin[static_cast<std::size_t>(r)];
  Mesh metric = mesh;
  auto& p = metric.positions.edit();
  for (std::size_t k = 0; k + 2 < p.size(); k += 3) {
    const Vec3 q = frame.point({p[k], p[k + 1], p[k + 2]});
    std::copy(q.begin(), q.end(), p.begin() + static_cast<std::ptrdiff_t>(k));
  }
  auto samples =
      simplify::sample_surface(triangles_of(metric), std::clamp<std::size_t>(4 * mesh.n_faces(), 100, 4000));
  const Matrix back = simplify::inverse(frame);
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / samples_of_leaving);
  for (const Matrix& m : s.places) {
    const Matrix place = m * back;
    const double grown = std::pow(scale_of(m) / scale_of(s.places[s.widest]), 2);
    for (std::size_t k = 0; k < samples.size(); k += stride)
      parts[i].leaving.push_back(
          {place.point(samples[k].point), samples[k].weight * grown * static_cast<double>(stride)});
  }
  look_around(i, frame, samples);
  CollapseOptions collapse = options.collapse;
  for (std::uint32_t k = 0; k < original.size(); ++k)
    if (std::ranges::binary_search(s.fixed, original[k])) collapse.fixed.push_back(k);
  parts[i].rungs = simplify::make_ladder({mesh, frame, samples, collapse});
}

namespace {

std::vector<std::size_t> drawn_counts(const WorldSimplifyOptions& options, std::size_t n) {
  std::vector<std::size_t> out = options.counts;
  if (options.every > 0 && n > 0)
    for (std::size_t k = (n - 1) / options.every * options.every; k > 0; k -= options.every) out.push_back(k);
  for (double r : options.ratios) out.push_back(static_cast<std::size_t>(r * static_cast<double>(n)));
  std::erase_if(out, [&](std::size_t k) { return k >= n; });
  std::ranges::sort(out, std::greater{});
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

void WorldLevels::Impl::allocate() {
  simplify::Allocation allocation(parts, neighbours, area);
  auto before = allocation.n_drawn();
  for (const auto count : drawn_counts(options, n_drawn)) {
    allocation.run_to(count);
    if (allocation.n_drawn() == before) continue;
    before = allocation.n_drawn();
    Point point{before, 0, allocation.n_gone(), allocation.rms(), allocation.max()};
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (allocation.rungs()[i] != simplify::Allocation::gone)
        point.n_faces += parts[i].rungs[allocation.rungs()[i]].n_faces;
    points.push_back(point);
    rungs.push_back(allocation.rungs());
  }
}

bool WorldLevels::Impl::is_changed(const WorldSurface& s, const std::vector<std::uint32_t>& at) const {
  return std::any_of(at.begin() + s.first_part, at.begin() + s.first_part + s.n_parts,
                     [](std::uint32_t rung) { return rung != 0; });
}

Mesh WorldLevels::Impl::mesh_at(const WorldSurface& s, const std::vector<std::uint32_t>& at) const {
  Mesh out;
  out.kind = Mesh::Kind::faces;
  std::vector<std::uint32_t> original;
  bool loose = false;
  for (std::uint32_t i = s.first_part; i < s.first_part + s.n_parts; ++i) {
    if (at[i] == simplify::Allocation::gone) continue;
    const auto& rung = parts[i].rungs[at[i]];
    loose |= rung.loose;
    append(out, at[i] == 0 ? piece_of(s.mesh, pieces[i].faces, original) : rung.mesh);
  }
  out.ccw = s.mesh.ccw;
  out.solid = s.mesh.solid && !loose;
  out.convex = true;
  out.crease_angle = s.mesh.normal.present() && !out.normal.present() ? options.collapse.crease_angle
                                                                       : s.mesh.crease_angle;
  return out;
}

WorldLevels::WorldLevels(const Scene& scene, const WorldSimplifyOptions& options, Task& ctx)
    : impl_(std::make_unique<Impl>(scene, options)) {
  auto& w = *impl_;
  w.read(ctx);
  if (drawn_counts(options, w.n_drawn).empty()) return;
  w.cut();
  if (w.pieces.size() < 2) return;
  for (std::size_t i = 0; i < w.pieces.size(); ++i) {
    auto& piece = w.pieces[i];
    const auto& s = w.surfaces[piece.surface];
    const auto triangles = triangles_of(s.mesh);
    const double scale = scale_of(s.places[s.widest]);
    for (auto f : piece.faces)
      if (const auto c = triangles[f]; is_usable(c)) {
        const Vec3 n = area_normal(c);
        piece.area += std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2 * scale * scale;
      }
    w.area += piece.area * std::sqrt(w.parts[i].weight * static_cast<double>(s.places.size()));
  }
  parallel_for(w.pieces.size(), [&](std::size_t i) { w.make_part(i); });
  w.allocate();
}

WorldLevels::~WorldLevels() = default;

std::size_t WorldLevels::n_drawn() const { return impl_->n_drawn; }
std::size_t WorldLevels::n_faces() const { return impl_->n_faces; }
std::size_t WorldLevels::n_parts() const { return impl_->pieces.size(); }
const std::vector<WorldLevels::Point>& WorldLevels::points() const { return impl_->points; }

Scene WorldLevels::scene_at(std::size_t i) const {
  Scene out = impl_->scene;
  const auto& at = impl_->rungs[i];
  for (const auto& s : impl_->surfaces) {
    if (!impl_->is_changed(s, at)) continue;
    const Mesh mesh = impl_->mesh_at(s, at);
    if (!mesh.corners.empty())
      store_mesh(out, s.surface.geometry, mesh);
    else
      for (NodeId shape : s.surface.shapes) out.unset(shape, nodes::shape::geometry.slot);
  }
  return out;
}

Scene WorldLevels::scene_with_levels() const {
  Scene out = impl_->scene;
  LodNodes nodes(out);
  for (const auto& s : impl_->surfaces) {
    std::vector<MeshLevel> levels;
    const double scale = scale_of(s.places[s.widest]);
    for (const auto& at : impl_->rungs) {
      if (!impl_->is_changed(s, at)) continue;
      Mesh mesh = impl_->mesh_at(s, at);
      if (!levels.empty() && levels.back().mesh.n_faces() == mesh.n_faces()) continue;
      double error = 0;
      for (std::uint32_t i = s.first_part; i < s.first_part + s.n_parts; ++i) {
        const auto& rungs = impl_->parts[i].rungs;
        error = std::max(error, rungs[std::min<std::size_t>(at[i], rungs.size() - 1)].distortion.max);
      }
      levels.push_back({std::move(mesh), 0, error / scale});
    }
    nodes.add(s.surface, s.mesh, levels, impl_->options.budget);
  }
  nodes.replace_shapes();
  return out;
}

}  // namespace wrlkit

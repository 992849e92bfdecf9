#include "writers/gltf/meshes.h"

#include <algorithm>

#include "scenegraph/features.h"
#include "scenegraph/nodes.h"
#include "writers/gltf/meshopt.h"
#include "writers/gltf/origin.h"

namespace wrlkit::gltf {
namespace {

Mode mode_of(Mesh::Kind k) {
  return k == Mesh::Kind::points ? Mode::points : k == Mesh::Kind::lines ? Mode::lines : Mode::triangles;
}

bool counts_up(std::span<const std::uint32_t> index, std::size_t n_vertices) {
  if (index.size() != n_vertices) return false;
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] != i) return false;
  return true;
}

/// Of the faces that triangles were cut from: how many triangles, how often in a row.
std::vector<std::uint32_t> runs(const Mesh& mesh) {
  std::vector<std::uint32_t> out;
  bool polygons = false;
  for (auto n : mesh.cut) {
    if (n == 0) continue;
    polygons |= n > 1;
    if (!out.empty() && out[out.size() - 2] == n)
      ++out.back();
    else
      out.insert(out.end(), {n, 1});
  }
  return polygons ? out : std::vector<std::uint32_t>{};
}

std::uint32_t n_different(std::vector<float> v) {
  std::ranges::sort(v);
  return static_cast<std::uint32_t>(std::unique(v.begin(), v.end()) - v.begin());
}

}  // namespace

std::uint32_t Meshes::geometry(NodeId n, bool picture) {
  auto add = [&](bool texcoords) {
    geometries_.push_back(make(n, texcoords));
    return static_cast<std::uint32_t>(geometries_.size() - 1);
  };
  std::uint32_t& known = by_node_[n.value];
  if (known == none) return known = add(picture || gives_texcoords(scene_, n));
  const Geometry& g = geometries_[known];
  if (!picture || g.texcoords != none || g.mode != Mode::triangles || gives_texcoords(scene_, n)) return known;
  if (g.textured == none) {
    auto textured = add(true);
    geometries_[known].textured = textured;
  }
  return geometries_[known].textured;
}

/// The mesh of a geometry. Flat faces that will move have a normal of their own each, even where they lie in one plane
/// now.
const Mesh& Meshes::mesh_of(NodeId n) {
  const Mesh& mesh = source_(n);
  moving_ = morphs_.moves(n);
  if (!morphs_.makes_normals(n) || !mesh.normal.present() || mesh.crease_angle > 0) return mesh;
  faceted_ = mesh;
  auto& normal = faceted_.normal;
  normal.values.clear();
  std::size_t face = 0;
  auto add = [&](std::size_t n_pieces) {
    if (face >= mesh.n_faces()) return;
    const auto id = static_cast<std::uint32_t>(normal.values.size() / 3);
    const float* value = mesh.normal.at(mesh.normal.index[mesh.begin_of(face)]);
    normal.values.insert(normal.values.end(), value, value + 3);
    for (; n_pieces > 0 && face < mesh.n_faces(); --n_pieces, ++face)
      std::fill(normal.index.begin() + static_cast<std::ptrdiff_t>(mesh.begin_of(face)),
                normal.index.begin() + static_cast<std::ptrdiff_t>(mesh.end_of(face)), id);
  };
  for (auto n_pieces : mesh.cut) add(n_pieces);
  while (face < mesh.n_faces()) add(1);
  return faceted_;
}

Geometry Meshes::repeated(NodeId n, bool texcoords) const {
  const NodeId other = same_mesh_ && !morphs_.moves(n) ? same_mesh_(n) : NodeId{};
  auto id = other ? by_node_[other.value] : none;
  if (id != none && geometries_[id].made_texcoords != texcoords) id = geometries_[id].textured;
  if (id == none || !geometries_[id].repeatable) return {};
  Geometry g = geometries_[id];
  g.source = n;
  g.first_mesh = g.textured = none;
  g.scale = 0;
  return g;
}

Geometry Meshes::make(NodeId n, bool texcoords) {
  if (Geometry g = repeated(n, texcoords); !g.empty()) return g;
  const auto n_said = diag_.count();
  const Mesh& mesh = mesh_of(n);
  Geometry g{.source = n,
             .mode = mode_of(mesh.kind),
             .double_sided = mesh.kind == Mesh::Kind::faces && !mesh.solid,
             .made_texcoords = texcoords};
  feature_of_corner_.clear();
  if (!number_parts(n, mesh))
    diag_.report(Diag::no_gltf_value, scene_.where(n), scene_.type(n).name,
                 "metadata (faces of parts that a pass has changed)");
  if (!take_vertices(n, texcoords)) split(mesh, texcoords);
  const Vertices& v = vertices_;
  if (v.n_not_finite > 0)
    diag_.report(Diag::float_overflow, scene_.where(n),
                 std::string(scene_.type(n).name) + " (" + std::to_string(v.n_not_finite) + " numbers)");
  if (v.index.empty()) return g;
  if (!options_.ordered && scene_.is(n, nodes::IndexedFaceSet) && v.index.size() == mesh.corners.size())
    g.polygons = add_polygons(runs(mesh));
  g.origin = move_near_origin(mesh, texcoords);
  g.rounding = report_coarse(n, mesh);
  std::uint32_t positions = store_.positions(v.position, {v.min, v.max});
  if (!v.normal.empty()) g.normals = store_.vertices(View::normal, v.normal);
  g.opacity = v.color_width == 4;
  if (!v.color.empty()) g.colors = store_.vertices(v.color_width == 4 ? View::rgba : View::rgb, v.color);
  if (!v.texcoord.empty()) g.texcoords = store_.vertices(View::texcoord, v.texcoord);
  if (!v.lightcoord.empty()) g.lightcoords = store_.vertices(View::texcoord, v.lightcoord);
  if (!v.feature.empty()) {
    g.features = store_.vertices(View::feature, v.feature);
    g.n_features = n_different(v.feature);
  }
  if (!counts_up(v.index, v.count())) g.indices = store_.indices(v.index, v.count());
  g.morph = morphs_.add(n, mesh, scratch_, v);
  if (!store_.full()) g.positions = positions;
  // What was said of it stays unsaid when it is made for the second time, with texture coordinates.
  const auto first = by_node_[n.value];
  g.repeatable = g.morph == none && g.features == none && diag_.count() == n_said &&
                 (first == none || geometries_[first].repeatable);
  return g;
}

std::uint32_t Meshes::add_polygons(const std::vector<std::uint32_t>& runs) {
  if (runs.empty()) return none;
  const auto [i, is_new] = known_polygons_.try_emplace(runs, static_cast<std::uint32_t>(polygons_.size()));
  if (is_new) polygons_.push_back(&i->first);
  return i->second;
}

void Meshes::split(const Mesh& mesh, bool texcoords, const Vec3& origin) {
  const bool has_parts = !feature_of_corner_.empty();
  auto options = options_with(texcoords);
  options.ordered &= !moving_ && !has_parts;
  make_vertices(mesh, options, scratch_, vertices_, origin);
  if (!has_parts) return;
  vertices_.feature.resize(vertices_.count());
  for (std::size_t c = 0; c < feature_of_corner_.size(); ++c)
    vertices_.feature[scratch_.of_corner[c]] = feature_of_corner_[c];
  if (options_.ordered && mesh.kind == Mesh::Kind::faces && !moving_) order_for_drawing(vertices_);
}

VertexOptions Meshes::options_with(bool texcoords) const {
  auto options = options_;
  options.texcoords = texcoords;
  return options;
}

/// False: the vertices were not made ahead.
bool Meshes::take_vertices(NodeId n, bool texcoords) {
  if (!ahead_ || moving_ || !feature_of_corner_.empty()) return false;
  Vertices* made = ahead_(n, options_with(texcoords));
  if (made) std::swap(vertices_, *made);
  return made;
}

/// The names of parts get numbers that are those of the whole file. False when parts and faces do not agree.
bool Meshes::number_parts(NodeId n, const Mesh& mesh) {
  const auto parts = features_of(scene_, n);
  if (!parts) return true;
  const auto& cut = mesh.cut;
  if (parts->n_faces() != (cut.empty() ? mesh.n_faces() : cut.size())) return false;
  std::size_t face = 0;
  for (std::size_t p = 0; p < parts->names.size(); ++p) {
    const auto row = parts_.of_path(parts->names[p]);
    any_features_ = true;
    for (std::int32_t i = 0; i < parts->faces[p]; ++i, ++face) {
      const std::size_t corners = cut.empty() ? mesh.end_of(face) - mesh.begin_of(face) : cut[face] * std::size_t{3};
      feature_of_corner_.insert(feature_of_corner_.end(), corners, static_cast<float>(row));
    }
  }
  return true;
}

std::uint32_t Meshes::move_near_origin(const Mesh& mesh, bool texcoords) {
  const auto &low = vertices_.min, &high = vertices_.max;
  const auto origin = mesh_origin({{low[0], low[1], low[2]}, {high[0], high[1], high[2]}});
  if (!origin) return none;
  split(mesh, texcoords, *origin);
  origins_.push_back(*origin);
  return static_cast<std::uint32_t>(origins_.size() - 1);
}

/// A mesh that reaches too far for an origin of its own to help, with details that are no larger than the last digit.
double Meshes::report_coarse(NodeId n, const Mesh& mesh) {
  constexpr double least_reach = 1 << 14;  // up to there single precision says millimetres
  double reach = 0, worst = 0, most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    reach = std::max({reach, std::abs(double{vertices_.min[i]}), std::abs(double{vertices_.max[i]})});
  if (reach < least_reach) return 0;
  auto at = [&](std::size_t corner, std::size_t i) {
    return mesh.positions[mesh.corners[corner] * std::size_t{3} + i] - vertices_.origin[i];
  };
  for (std::size_t f = 0; f < mesh.n_faces(); ++f) {
    double moved = 0, size = 0;
    for (auto c = mesh.begin_of(f); c < mesh.end_of(f); ++c)
      for (std::size_t i = 0; i < 3; ++i) {
        moved = std::max(moved, std::abs(at(c, i) - static_cast<float>(at(c, i))));
        size = std::max(size, std::abs(at(c, i) - at(mesh.begin_of(f), i)));
      }
    most = std::max(most, moved);
    if (moved > size / 4) worst = std::max(worst, moved);
  }
  if (worst > 0) diag_.report(Diag::coarse_positions, scene_.where(n), scene_.type(n).name, worst);
  return std::sqrt(3) * most;
}

std::uint32_t Meshes::mesh(std::uint32_t geometry, const MaterialUse& use) {
  Geometry& g = geometries_[geometry];
  for (std::uint32_t m = g.first_mesh; m != none; m = meshes_[m].next)
    if (meshes_[m].material == use.material && meshes_[m].bake == use.bake && meshes_[m].bake_light == use.bake_light)
      return m;
  std::uint32_t texcoords = use.bake ? baked(g, use.bake, &Vertices::texcoord) : g.texcoords;
  std::uint32_t lightcoords = !use.shows_light ? none
                              : use.bake_light ? baked(g, use.bake_light, &Vertices::lightcoord)
                                               : g.lightcoords;
  auto id = static_cast<std::uint32_t>(meshes_.size());
  meshes_.push_back(
      {geometry, use.material, texcoords, lightcoords, g.first_mesh, use.bake, use.bake_light, use.shows_color});
  return g.first_mesh = id;
}

/// The texture transform is applied before V is turned round, so the coordinates are turned back and forth.
std::uint32_t Meshes::baked(const Geometry& g, NodeId texture_transform, std::vector<float> Vertices::*places) {
  const TexcoordMap map = read_texture_transform(scene_, texture_transform).map();
  split(mesh_of(g.source), g.texcoords != none);
  auto& uv = vertices_.*places;
  for (std::size_t i = 0; i + 1 < uv.size(); i += 2) {
    auto [s, t] = map(uv[i], 1.0 - uv[i + 1]);
    uv[i] = static_cast<float>(s);
    uv[i + 1] = static_cast<float>(1 - t);
  }
  return store_.vertices(View::texcoord, uv);
}

Box Meshes::bounds(const Geometry& g, const Matrix& frame) const {
  const auto& b = store_.bounds_of(g.positions);
  Vec3 middle, half;
  for (std::size_t i = 0; i < 3; ++i) {
    middle[i] = (double{b.low[i]} + b.high[i]) / 2 + (g.origin == none ? 0 : origins_[g.origin][i]);
    half[i] = (double{b.high[i]} - b.low[i]) / 2;
  }
  Vec3 at = frame.point(middle);
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) reach += std::abs(frame.m[i * 4 + k]) * half[k];
    box.low[i] = at[i] - reach;
    box.high[i] = at[i] + reach;
  }
  return box;
}

}  // namespace wrlkit::gltf

#include "passes/subdivide/subdivide.h"

#include "passes/analysis/manifold.h"

#ifdef WRLKIT_OPENMESH

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <algorithm>
#include <array>
#include <numbers>
#include <unordered_map>

#include "geometry/openmesh/openmesh.h"
#include "geometry/triangulation.h"

#endif

namespace wrlkit {

#ifdef WRLKIT_OPENMESH

namespace {

using Scheme = SubdivisionScheme;
using Loop = OpenMesh::Subdivider::Uniform::LoopT<OpenMeshPolygons>;
using CatmullClark = OpenMesh::Subdivider::Uniform::CatmullClarkT<OpenMeshPolygons>;

/// One level: faces of the fine mesh, in the order of the coarse faces that they are parts of. OpenMesh numbers what
/// it makes: behind the old vertices there is one for each edge, then (Catmull-Clark) one for each face; behind the old
/// faces there are the further parts of the first face, of the second, and so on.
class Refinement {
 public:
  Refinement(Mesh& mesh, OpenMeshPolygons& surface, Scheme scheme, StampedMap& corner_of)
      : mesh_(mesh), surface_(surface), scheme_(scheme), corner_of_(corner_of), n_old_(surface.n_vertices()) {}

  void run() {
    for (auto e : surface_.edges()) {
      const auto h = surface_.halfedge_handle(e, 0);
      ends_.push_back({number(surface_.from_vertex_handle(h)), number(surface_.to_vertex_handle(h))});
    }
    const std::size_t n_coarse = surface_.n_faces();
    coarse_ = mesh_;
    to_vertex_numbers();
    subdivide();
    mesh_.corners.clear();
    mesh_.face_begin.assign(1, 0);
    for (Attribute* a : mesh_.attributes()) a->index.clear();
    std::size_t next = n_coarse;
    for (std::size_t f = 0; f < n_coarse; ++f) {
      enter(f);
      add_part(f);
      for (std::size_t i = 1; i < n_parts(f); ++i) add_part(next++);
    }
    take_positions();
    if (scheme_ == Scheme::loop) mesh_.face_begin.clear();
  }

 private:
  static std::uint32_t number(OpenMesh::VertexHandle v) { return static_cast<std::uint32_t>(v.idx()); }

  /// The corners of the coarse mesh by the vertices of the surface, whose order is that of their first use.
  void to_vertex_numbers() {
    std::size_t corner = 0;
    for (auto face : surface_.faces())
      for (auto v : surface_.fv_range(face)) coarse_.corners[corner++] = number(v);
  }

  /// Not with the constructors that take a mesh: these call functions that are still pure virtual.
  void subdivide() {
    if (scheme_ == Scheme::catmull_clark) {
      CatmullClark catmull_clark;
      catmull_clark(surface_, 1);
      return;
    }
    // Its table of weights ends at 50 edges, which it does not check.
    std::size_t most = 0;
    for (auto v : surface_.vertices()) most = std::max<std::size_t>(most, surface_.valence(v));
    Loop loop;
    loop.init_weights(most + 1);
    loop(surface_, 1);
  }

  std::size_t n_parts(std::size_t face) const {
    return scheme_ == Scheme::loop ? 4 : coarse_.end_of(face) - coarse_.begin_of(face);
  }

  /// Corners of the coarse face by their vertices.
  void enter(std::size_t face) {
    first_ = coarse_.begin_of(face);
    last_ = coarse_.end_of(face);
    corner_of_.reset(n_old_);
    for (std::size_t c = first_; c < last_; ++c) corner_of_.set(coarse_.corners[c], static_cast<std::uint32_t>(c));
    middle_.fill(none);
  }

  void add_part(std::size_t face) {
    for (auto v : surface_.fv_range(OpenMesh::FaceHandle(static_cast<int>(face)))) {
      mesh_.corners.push_back(number(v));
      for (std::size_t i = 0; i < middle_.size(); ++i)
        if (const Attribute& from = *std::as_const(coarse_).attributes()[i]; from.present())
          mesh_.attributes()[i]->index.push_back(value(i, number(v)));
    }
    mesh_.face_begin.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
  }

  std::uint32_t value(std::size_t attribute, std::uint32_t vertex) {
    const auto& index = std::as_const(coarse_).attributes()[attribute]->index;
    if (vertex < n_old_) return index[corner_of_[vertex]];
    if (vertex - n_old_ < ends_.size()) {
      const auto [a, b] = ends_[vertex - n_old_];
      return middle(attribute, index[corner_of_[a]], index[corner_of_[b]]);
    }
    if (middle_[attribute] == none) middle_[attribute] = mean(attribute);
    return middle_[attribute];
  }

  /// Half way between two values; the same for both faces of an edge.
  std::uint32_t middle(std::size_t attribute, std::uint32_t a, std::uint32_t b) {
    if (a == b) return a;
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    Attribute& to = *mesh_.attributes()[attribute];
    const auto [at, is_new] = half_[attribute].try_emplace(key, static_cast<std::uint32_t>(to.count()));
    for (int k = 0; is_new && k < to.width; ++k) to.values.push_back((to.at(a)[k] + to.at(b)[k]) / 2);
    return at->second;
  }

  std::uint32_t mean(std::size_t attribute) {
    Attribute& to = *mesh_.attributes()[attribute];
    const auto& index = std::as_const(coarse_).attributes()[attribute]->index;
    const auto first = index.begin() + static_cast<std::ptrdiff_t>(first_);
    const auto last = index.begin() + static_cast<std::ptrdiff_t>(last_);
    if (std::all_of(first, last, [&](std::uint32_t i) { return i == *first; })) return *first;
    for (int k = 0; k < to.width; ++k) {
      double sum = 0;
      for (auto i = first; i != last; ++i) sum += to.values[std::size_t{*i} * to.width + k];
      to.values.push_back(static_cast<float>(sum / static_cast<double>(last_ - first_)));
    }
    return static_cast<std::uint32_t>(to.count() - 1);
  }

  void take_positions() {
    auto& positions = mesh_.positions.edit();
    positions.clear();
    for (auto v : surface_.vertices()) {
      const auto& p = surface_.point(v);
      positions.insert(positions.end(), p.data(), p.data() + 3);
    }
  }

  static constexpr std::uint32_t none = 0xffffffffu;

  Mesh& mesh_;
  Mesh coarse_;
  OpenMeshPolygons& surface_;
  const Scheme scheme_;
  StampedMap& corner_of_;
  const std::size_t n_old_;
  std::vector<std::array<std::uint32_t, 2>> ends_;  // of the coarse edges
  std::size_t first_ = 0, last_ = 0;                // corners of the coarse face that is entered
  std::array<std::uint32_t, 4> middle_{};           // value in the middle of it, by attribute
  std::array<std::unordered_map<std::uint64_t, std::uint32_t>, 4> half_;
};

/// Triangles that there will be.
double triangles_of(const Mesh& mesh, const SubdivideOptions& options) {
  double quads = static_cast<double>(mesh.corners.size());
  if (options.scheme == Scheme::loop) {
    // Each polygon of n corners is n - 2 triangles, four at the first level: two quads.
    quads = 2 * (quads - 2 * static_cast<double>(mesh.n_faces()));
  }
  for (int i = 1; i < options.levels; ++i) quads *= 4;
  return 2 * quads;
}

bool is_within_limit(MeshJob& job, const SubdivideOptions& options) {
  const double more = triangles_of(job.mesh, options);
  auto& count = job.ctx.stats["subdivide.triangles"];
  if (static_cast<double>(count) + more > options.max_triangles) {
    const auto n = std::to_string(static_cast<std::uint64_t>(more) + count) + " triangles";
    job.ctx.diag.report(Diag::too_large, job.scene.where(job.geometry), n, options.max_triangles,
                        "subdivide leaves this surface as it is");
    return false;
  }
  count += static_cast<std::uint64_t>(more);
  return true;
}

}  // namespace

Outcome subdivide(MeshJob& job, const SubdivideOptions& options) {
  if (!is_for_openmesh(job, "subdivide")) return Outcome::unchanged;
  auto surface = manifold_of(job, "subdivide");
  if (!surface || !is_within_limit(job, options)) return Outcome::unchanged;
  drop_normals(job, "subdivide");
  for (int i = 0; i < options.levels; ++i) {
    const bool cut = i == 0 && options.scheme == Scheme::loop && !job.mesh.is_triangles();
    if (cut) cut_into_triangles(job);
    if (cut || i > 0) surface = to_openmesh(job.mesh, false);
    Refinement(job.mesh, surface->mesh, options.scheme, job.scratch.map).run();
  }
  job.mesh.cut.clear();
  job.mesh.primitive = false;
  job.mesh.crease_angle = std::numbers::pi;
  return Outcome::changed;
}

#else

Outcome subdivide(MeshJob& job, const SubdivideOptions&) {
  is_for_openmesh(job, "subdivide");
  return Outcome::unchanged;
}

#endif

}  // namespace wrlkit

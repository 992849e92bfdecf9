// OpenMesh's decimater with its quadrics and against flipped normals, behind the interface of the collapser. A vertex
// goes into one of its neighbours, which stays where it is. Borders and seams go along themselves only, as in the
// engine; faces that are no manifold stay as they are.
#include "geometry/simplify/simplifier.h"

#ifdef WRLKIT_OPENMESH

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <algorithm>
#include <cmath>

#include "geometry/openmesh/face_adder.h"
#include "geometry/simplify/features.h"

namespace wrlkit::simplify {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  typedef OpenMesh::Vec3d Point;
  typedef OpenMesh::Vec3d Normal;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  VertexTraits { double deviation = 0; };
  HalfedgeTraits { std::uint32_t wedge = none; };
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Decimater = OpenMesh::Decimater::DecimaterT<HalfEdges>;

/// Keeps the wedges of the corners right, and the distance from the original within a limit. It has nothing to say of
/// the order.
template <class M>
class KeeperT : public OpenMesh::Decimater::ModBaseT<M> {
 public:
  DECIMATING_MODULE(KeeperT, M, Keeper);

  explicit KeeperT(M& mesh) : Base(mesh, true) {}

  float collapse_priority(const CollapseInfo& ci) override {
    return deviation_of(ci) <= most_ ? Base::LEGAL_COLLAPSE : Base::ILLEGAL_COLLAPSE;
  }

  void preprocess_collapse(const CollapseInfo& ci) override {
    const double d = deviation_of(ci);
    auto& kept = this->mesh().data(ci.v1).deviation;
    kept = std::max(kept, d);
    error_ = std::max(error_, d);
    keep_features(ci);
    keep_wedges(ci);
  }

  void set_most(double most) { most_ = most; }
  double error() const { return error_; }

 private:
  /// What v0 has already, and how far its new place is from the planes of the faces around it.
  double deviation_of(const CollapseInfo& ci) {
    double distance = 0;
    for (auto f : this->mesh().vf_range(ci.v0))
      distance = std::max(distance, std::abs(dot(this->mesh().normal(f), ci.p1 - ci.p0)));
    return this->mesh().data(ci.v0).deviation + distance;
  }

  /// Where a face goes, two of its edges become one.
  void keep_features(const CollapseInfo& ci) {
    auto unite = [&](auto h, auto g) {
      auto &a = this->mesh().status(this->mesh().edge_handle(h)), &b = this->mesh().status(this->mesh().edge_handle(g));
      const bool feature = a.feature() || b.feature();
      a.set_feature(feature);
      b.set_feature(feature);
    };
    if (ci.vl.is_valid()) unite(ci.v0vl, ci.vlv1);
    if (ci.vr.is_valid()) unite(ci.vrv0, ci.v1vr);
  }

  /// The faces that go say which wedge of v1 takes the place of which of v0.
  void keep_wedges(const CollapseInfo& ci) {
    std::uint32_t from[2] = {none, none}, to[2] = {none, none};
    if (ci.fl.is_valid()) {
      from[0] = this->mesh().data(this->mesh().prev_halfedge_handle(ci.v0v1)).wedge;
      to[0] = this->mesh().data(ci.v0v1).wedge;
    }
    if (ci.fr.is_valid()) {
      from[1] = this->mesh().data(ci.v1v0).wedge;
      to[1] = this->mesh().data(this->mesh().prev_halfedge_handle(ci.v1v0)).wedge;
    }
    const std::uint32_t otherwise = to[0] != none ? to[0] : to[1];
    for (auto h : this->mesh().vih_range(ci.v0)) {
      auto& wedge = this->mesh().data(h).wedge;
      wedge = wedge == from[0] ? to[0] : wedge == from[1] ? to[1] : otherwise;
    }
  }

  double most_ = 0, error_ = 0;
};

class OpenMeshSimplifier final : public Simplifier {
 public:
  OpenMeshSimplifier(const Mesh& mesh, const CollapseOptions& options)
      : Simplifier(mesh), decimater_(mesh_), n_faces_(surface_.n_faces()) {
    omerr().disable();  // what it would print is looked at here
    find_features(surface_, wedges_, {options.keep_borders, false, options.crease_angle, options.fixed});
    add_faces();
    for (std::uint32_t v = 0; v < surface_.n_vertices(); ++v) mark(v);
    mesh_.update_face_normals();
    OpenMesh::Decimater::ModQuadricT<HalfEdges>::Handle quadric;
    OpenMesh::Decimater::ModNormalFlippingT<HalfEdges>::Handle flipping;
    decimater_.add(quadric);
    decimater_.add(flipping);
    decimater_.add(keeper_);
    decimater_.module(quadric).unset_max_err();
    decimater_.initialize();
  }

  void run_to(std::size_t n_faces, double max_error) override {
    if (n_faces >= n_faces_) return;
    auto& keeper = decimater_.module(keeper_);
    keeper.set_most(max_error);
    // It counts faces that are gone among those that are there.
    const std::size_t gone = surface_.n_faces() - n_faces_;
    const std::size_t apart = surface_.n_faces() - mesh_.n_faces();
    decimater_.decimate_to_faces(0, std::max(n_faces, apart) - apart + gone);
    error_ = keeper.error();
    take_over();
  }

  std::size_t n_faces() const override { return n_faces_; }

 private:
  void add_faces() {
    for (std::uint32_t v = 0; v < surface_.n_vertices(); ++v) {
      const Vec3& p = surface_.position(v);
      mesh_.add_vertex({p[0], p[1], p[2]});
    }
    FaceAdder adder(mesh_);
    handle_.resize(surface_.n_slots());
    for (std::uint32_t f = 0; f < surface_.n_slots(); ++f) {
      if (!surface_.alive(f)) continue;
      const auto& v = surface_.face[f].v;
      handle_[f] = adder.add(v);
      if (handle_[f].is_valid()) {
        set_wedges(f);
        continue;
      }
      for (std::uint32_t w : v) surface_.vertex[w].kind = Kind::fixed;
    }
  }

  void set_wedges(std::uint32_t f) {
    for (auto h : mesh_.fh_range(handle_[f])) {
      const int k = corner(f, mesh_.to_vertex_handle(h)), from = corner(f, mesh_.from_vertex_handle(h));
      if (wedges_.present()) mesh_.data(h).wedge = wedges_.of_face[f][k];
      const bool feature = surface_.face[f].features >> from & 1;
      if (feature) mesh_.status(mesh_.edge_handle(h)).set_feature(true);
    }
  }

  int corner(std::uint32_t f, OpenMesh::VertexHandle v) const {
    const auto& face = surface_.face[f].v;
    return static_cast<int>(std::ranges::find(face, static_cast<std::uint32_t>(v.idx())) - face);
  }

  void mark(std::uint32_t v) {
    const Kind kind = surface_.vertex[v].kind;
    auto& status = mesh_.status(OpenMesh::VertexHandle(static_cast<int>(v)));
    status.set_feature(kind == Kind::line);
    status.set_locked(kind == Kind::corner || kind == Kind::fixed);
  }

  /// Faces and wedges as the decimater has left them.
  void take_over() {
    n_faces_ = 0;
    for (std::uint32_t f = 0; f < surface_.n_slots(); ++f) {
      if (!surface_.alive(f)) continue;
      const bool gone = handle_[f].is_valid() && mesh_.status(handle_[f]).deleted();
      n_faces_ += !gone;
      if (gone)
        surface_.face[f].v[0] = none;
      else if (handle_[f].is_valid())
        take_over(f);
    }
  }

  void take_over(std::uint32_t f) {
    int k = 0;
    for (auto h : mesh_.fh_range(handle_[f])) {
      surface_.face[f].v[k] = static_cast<std::uint32_t>(mesh_.to_vertex_handle(h).idx());
      if (wedges_.present()) wedges_.of_face[f][k] = mesh_.data(h).wedge;
      ++k;
    }
  }

  HalfEdges mesh_;
  Decimater decimater_;
  OpenMesh::Decimater::ModHandleT<KeeperT<HalfEdges>> keeper_;
  std::vector<OpenMesh::FaceHandle> handle_;  // of the faces of surface_; invalid: kept apart
  std::size_t n_faces_;
};

}  // namespace

const OwnSimplifier openmesh{[](const Mesh& mesh, const CollapseOptions& options) -> std::unique_ptr<Simplifier> {
  return std::make_unique<OpenMeshSimplifier>(mesh, options);
}};

}  // namespace wrlkit::simplify

#else

namespace wrlkit::simplify {

const OwnSimplifier openmesh{nullptr, "OpenMesh"};

}  // namespace wrlkit::simplify

#endif

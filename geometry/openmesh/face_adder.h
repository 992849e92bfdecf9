// Faces for a half-edge mesh of OpenMesh, of any traits: only those that keep it a manifold.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wrlkit {

/// Faces that a half-edge mesh cannot hold, by what is wrong with them.
struct NotManifold {
  std::size_t edges = 0;     // at an edge of more than two faces, or of two that are wound against each other
  std::size_t points = 0;    // at a point around which the faces are closed already
  std::size_t repeated = 0;  // with a point that occurs twice, or of fewer than three
  std::size_t crowded = 0;   // at a point of very many faces, which would cost the square of their number

  std::size_t count() const { return edges + points + repeated + crowded; }
};

/// `HalfEdgeMesh`: a PolyMesh or TriMesh of OpenMesh that has its vertices, and no faces yet.
template <class HalfEdgeMesh>
class FaceAdder {
 public:
  using FaceHandle = typename HalfEdgeMesh::FaceHandle;
  using VertexHandle = typename HalfEdgeMesh::VertexHandle;
  static constexpr std::uint32_t most_faces_of_a_point = 1024;

  explicit FaceAdder(HalfEdgeMesh& mesh) : mesh_(mesh), degree_(mesh.n_vertices()) {}

  /// Invalid when it cannot be added, which is counted. O(faces around its points).
  FaceHandle add(std::span<const std::uint32_t> vertices) {
    handles_.clear();
    for (std::uint32_t v : vertices) handles_.push_back(VertexHandle(static_cast<int>(v)));
    if (std::size_t* fault = fault_of(vertices)) {
      ++*fault;
      return FaceHandle();
    }
    const FaceHandle face = mesh_.add_face(handles_);
    if (!face.is_valid()) ++faults_.points;
    for (std::uint32_t v : vertices) degree_[v] += face.is_valid();
    return face;
  }
  const NotManifold& faults() const { return faults_; }

 private:
  std::size_t* fault_of(std::span<const std::uint32_t> vertices) {
    if (is_repeated(vertices)) return &faults_.repeated;
    for (std::uint32_t v : vertices)
      if (degree_[v] >= most_faces_of_a_point) return &faults_.crowded;
    for (std::size_t i = 0; i < handles_.size(); ++i) {
      if (!mesh_.is_boundary(handles_[i])) return &faults_.points;
      const auto edge = mesh_.find_halfedge(handles_[i], handles_[(i + 1) % handles_.size()]);
      if (edge.is_valid() && !mesh_.is_boundary(edge)) return &faults_.edges;
    }
    return nullptr;
  }

  /// In time linear in the corners.
  bool is_repeated(std::span<const std::uint32_t> vertices) {
    seen_.resize(degree_.size());
    bool repeated = vertices.size() < 3;
    for (std::uint32_t v : vertices) {
      repeated |= seen_[v] != 0;
      seen_[v] = 1;
    }
    for (std::uint32_t v : vertices) seen_[v] = 0;
    return repeated;
  }

  HalfEdgeMesh& mesh_;
  std::vector<std::uint32_t> degree_;
  std::vector<char> seen_;
  std::vector<VertexHandle> handles_;
  NotManifold faults_;
};

}  // namespace wrlkit

// Progressive meshes (Hoppe 1996): a coarse base mesh, and splits of vertices that undo the collapses of a
// simplification one by one, until the original is there again. Any number of triangles between the two is one walk
// away:
//
//   ProgressiveMesh p(*make_progressive(mesh, Criterion::lindstrom_turk));
//   p.refine_to(5000), draw(p.mesh());
//   p.coarsen_to(800), draw(p.mesh());
//
// Vertices, wedges (a vertex with one set of attribute values) and faces are numbered in the order in which they
// appear: those of the base, then those of each split. So a state is a prefix of each list, and what a split gives is
// not stored as numbers. What a vertex or face was called in the original is kept next to it.
//
// The original comes back with its faces, corners and positions in their order, bit for bit, but for what the Collapser
// drops: faces with a repeated position, and positions that no face uses (the numbers close up). Each corner has its
// attribute values bit for bit; equal rows of values at one vertex are one row.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/simplify/collapse.h"
#include "geometry/simplify/levels.h"

namespace wrlkit {

/// A progressive mesh as data: a base and its splits, coarse to fine.
struct ProgressiveRecord {
  using Point = std::array<double, 3>;
  struct Vertex {
    Point position;        // when it appears
    std::uint32_t number;  // in the original
  };
  struct Corner {
    std::uint32_t vertex = 0, wedge = 0;  // without attributes all wedges are 0
    bool operator==(const Corner&) const = default;
  };
  struct Face {
    std::array<Corner, 3> corners;  // when it appears
    std::uint32_t number;
  };
  /// A corner of the split vertex that goes to the new one. Corners are three times their face, plus 0, 1 or 2.
  struct CornerChange {
    std::uint32_t corner;
    std::uint32_t coarse, fine;  // wedges
  };
  struct WedgeChange {
    std::uint32_t wedge;
    std::uint32_t coarse, fine;  // rows of `width` floats in `values`
  };
  /// Split i splits `vertex` into itself and vertex n_base_vertices + i.
  struct Split {
    std::uint32_t vertex;
    Point coarse, fine;                                       // where the vertex was, and is then
    float error;                                              // of the mesh after it; never more than before
    std::size_t end_of_faces, end_of_corners, end_of_wedges;  // of its entries, which begin where the last split's end
  };

  Mesh flags;                                     // without arrays: the original's flags of its faces
  int n_normal = 0, n_color = 0, n_texcoord = 0;  // floats of each in a row of values, 0: not present

  std::size_t n_base_vertices = 0, n_base_wedges = 0, n_base_faces = 0;
  float base_error = 0;  // in units of the mesh, see Collapser::error
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> wedges;  // the row of each when it appears
  std::vector<Face> faces;
  std::vector<Split> splits;
  std::vector<CornerChange> corners;  // of each split by ascending corner
  std::vector<WedgeChange> wedge_changes;
  std::vector<float> values;

  int width() const { return n_normal + n_color + n_texcoord; }
};

/// Turns a record of collapses of `mesh` round, which has no lightcoord. O(n log n).
ProgressiveRecord make_progressive(const Mesh& mesh, const CollapseRecord& record);
/// Collapses a mesh of triangles (Mesh::is_triangles) until at most `base_faces` are left, or none may go any more, and
/// turns the record round. Nothing for a criterion that keeps no record.
std::optional<ProgressiveRecord> make_progressive(const Mesh& mesh, Criterion criterion,
                                                  std::size_t base_faces = faces_of_a_box);

/// A progressive mesh at one of its states; the base in the beginning.
class ProgressiveMesh {
 public:
  explicit ProgressiveMesh(ProgressiveRecord record);

  const ProgressiveRecord& record() const { return record_; }
  std::size_t n_faces() const { return n_faces_; }
  /// Estimate of the largest distance from the original, in units of the mesh.
  float error() const { return done_ ? record_.splits[done_ - 1].error : record_.base_error; }

  /// Splits until there are at least `n_faces` (a split brings two faces, or one at a border), or all. O(what changes).
  void refine_to(std::size_t n_faces);
  /// Takes splits back until there are at most `n_faces`, or the base is left. O(what changes).
  void coarsen_to(std::size_t n_faces);

  /// The faces that are there, with the positions and values that they use, both in the order of the original.
  /// O(n log n).
  Mesh mesh() const;

 private:
  void split();
  void collapse();

  ProgressiveRecord record_;
  std::size_t done_ = 0, n_faces_ = 0;  // splits, faces
  std::vector<ProgressiveRecord::Point> position_;
  std::vector<std::uint32_t> row_;  // of each wedge
  std::vector<ProgressiveRecord::Corner> corner_;
};

}  // namespace wrlkit

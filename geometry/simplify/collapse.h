// Simplification of triangle meshes by edge collapses: in each step the cheapest edge is replaced by one vertex, until
// few enough triangles are left. A Collapser is run further and further, so that one run gives a series of levels:
//
//   Collapser c(mesh, {.criterion = Criterion::melax});
//   c.run_to(1000), levels.push_back(c.mesh());
//   c.run_to(500), levels.push_back(c.mesh());
//
// What edge is the cheapest and where its vertex goes is the criterion's business (criterion.h). What is kept whatever
// the criterion says is the engine's:
//
// - Topology: the surface is not pinched, no hole is closed, no closed part goes below a tetrahedron.
// - Features: borders, seams (edges where the corners of both faces differ in color or texture coordinate, or in
// normals by
//   more than the crease angle) and edges of more than two faces. An edge of them collapses along itself only; other
//   edges collapse into them, never them away. A vertex where the surface touches itself stays where it is, exactly,
//   and so does one that is to be fixed.
// - Creases: the same, but a collapse that does not go along them is possible, for four times the cost. So they stay
// while
//   there is anything else to take; forbidden altogether, noisy scans and small budgets suffer (docs/rationale.md).
// - No face turns by 90 degrees or more in a collapse; slivers are not made of good faces. No face comes to lie back on
// a
//   neighbour, unless by steps of less than ten degrees, or where the faces between two sides of a sheet go;
//   length_normal and melax are left free to, as their formulas have it.
//
// Attributes of the corners are interpolated along the edge. Deterministic; single-threaded.
#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"

namespace wrlkit {

enum class Criterion : std::uint8_t {
#define PRICER(name) name,
#define SIMPLIFIER(name) name,
#include "geometry/simplify/criteria.def"
};

struct CriterionInfo {
  std::string name;
  bool keeps_record;         // has steps, and a record of them (CollapseOptions::record)
  std::string_view missing;  // the package that it needs and this build does without; empty: none
};
const CriterionInfo& info(Criterion);
std::span<const Criterion> all_criteria();

struct CollapseOptions {
  Criterion criterion = Criterion::lindstrom_turk;
  // Both false: the formulas of length_normal and melax are the paper's and nothing else.
  bool keep_borders = true;
  bool keep_creases = true;
  double crease_angle = 1.2;         // radians between the normals of two faces, from which on their edge is a crease
  bool record = false;               // fill Collapser::record
  std::vector<std::uint32_t> fixed;  // positions of the mesh that stay where they are, ascending
};

/// An edge and what becomes of it: vertex `from` goes into `to`, which moves to `position`. Vertices are called by
/// their number in the positions of the mesh that came in.
struct EdgeCollapse {
  std::uint32_t from, to;
  std::array<double, 3> position;
  double cost;  // in the criterion's own measure
};

/// The collapses in the order in which they were done, each with what it takes to do and to undo it. A corner is three
/// times the number of its face in the mesh that came in, plus 0, 1 or 2. A wedge is a vertex with one set of
/// attributes; without attributes, a vertex. A step takes its faces away, gives corners another wedge and wedges
/// another row of values; what wedges of `from` are left belong to `to` then.
struct CollapseRecord {
  struct Step : EdgeCollapse {
    std::array<double, 3> old_from, old_to;
    double error;  // Collapser::error() after this step
    std::size_t end_of_faces, end_of_corners,
        end_of_wedges;  // of its entries below, which begin where the last step's end
  };
  struct CornerChange {
    std::uint32_t corner, before, after;
  };  // wedges
  struct WedgeChange {
    std::uint32_t wedge, before, after;
  };  // into values, `width` floats each

  std::vector<Step> steps;
  std::vector<std::uint32_t> removed_faces;
  std::vector<CornerChange> corners;
  std::vector<WedgeChange> wedges;

  int width = 0;              // floats of a wedge: normal, color, texcoord, lightcoord, where present
  std::vector<float> values;  // of all wedges in the beginning, then what they became
  // In the beginning: the vertex of each wedge, and the wedge of each corner (0xffffffff: of a face that was dropped).
  std::vector<std::uint32_t> wedge_vertex, wedge_of_corner;
};

class Collapser {
 public:
  /// Takes a mesh of triangles (Mesh::is_triangles); copies what it needs of it. Faces with a repeated position are
  /// dropped at once. O(n).
  Collapser(const Mesh& triangles, const CollapseOptions& options);
  ~Collapser();
  Collapser(Collapser&&) noexcept;
  Collapser& operator=(Collapser&&) noexcept;

  /// Collapses the cheapest edge until at most `n_faces` are left (an edge takes two faces with it, so one less is
  /// possible), or until there is no edge that may go, or none that would leave error() at most `max_error`. Calling it
  /// for a series of targets gives the same as one run to the last. In meshes of more than 32,768 vertices, costs
  /// between two powers of four (of two: length_normal and melax) count as equal until 16,384 faces are left. O(n log
  /// n) all in all.
  void run_to(std::size_t n_faces, double max_error = std::numeric_limits<double>::infinity());

  std::size_t n_faces() const;
  /// Estimate of the largest distance from the surface that came in, in its units: each collapse adds the distance of
  /// the new vertex from the planes of the faces (and from the lines of the feature edges) that it changed.
  double error() const;

  /// What the next step of run_to will do; nothing when no edge may go.
  std::optional<EdgeCollapse> next();
  /// What it costs to collapse vertex `from` into `to` now; nothing when there is no such edge or it may not go that
  /// way.
  std::optional<double> cost(std::uint32_t from, std::uint32_t to);

  /// The faces that are left, in their old order, with the positions and attribute values that they use. The flags are
  /// those of the mesh that came in.
  Mesh mesh() const;

  /// Empty unless CollapseOptions::record.
  const CollapseRecord& record() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wrlkit

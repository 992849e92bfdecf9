// Neighbours that are wound against each other, and surfaces that are inside out.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/weld/edges.h"
#include "passes/weld/surface.h"

namespace wrlkit {

class Winding {
 public:
  struct Counts {
    std::size_t flipped_faces = 0, one_sided_parts = 0;
  };

  /// Reverses faces so that the two of each manifold edge run along it in opposite directions; see weld.h for which.
  /// With `outward`, closed parts that are consistent but inside out are reversed as well. Edges stay where they are,
  /// but the corners that they name do not. Near linear.
  void unify(const Surface&, const std::vector<SurfaceEdge>&, bool outward);

  Counts counts;

 private:
  struct Part {  // of faces that hang together by manifold edges; of faces wound like its first: 0, or against it: 1
    std::uint32_t n_faces[2];
    std::uint32_t n_corners, n_edges;
    double volume;  // as if all were wound like the first; six times
    bool one_sided, flip[2];
  };
  struct Member {
    std::uint32_t root, against;
  };

  void unite(const Surface&, const std::vector<SurfaceEdge>&);
  void sum_up(const Surface&, const std::vector<SurfaceEdge>&);
  void decide(Part&, bool ccw, bool outward);
  Member find(std::uint32_t face);
  void flip(const Surface&, std::uint32_t face);
  void flip_normals(const Surface&, std::uint32_t face);

  std::vector<std::uint32_t> links_;      // of each face: one of its part before it, twice; plus 1 if wound against it
  std::vector<std::uint32_t> conflicts_;  // faces of one-sided parts
  std::vector<Part> parts_;               // by their first face
  std::vector<std::uint32_t> opposite_;   // of each normal, its opposite
};

}  // namespace wrlkit

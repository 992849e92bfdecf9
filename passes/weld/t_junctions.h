// Points that lie on an edge of a face without being its corner: along such an edge the surface gapes, and nothing that
// walks over it comes across.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/weld/cell_grid.h"
#include "passes/weld/edges.h"
#include "passes/weld/surface.h"

namespace wrlkit {

class TJunctions {
 public:
  /// Makes the points of open edges that lie on another open edge corners of the face there, and returns how many it
  /// made; the edges are out of date then. A point is on an edge to within the tolerance, or the rounding error of
  /// double precision. Not if single precision takes it for an end of the edge: such points want to be joined. About
  /// linear; gives up finding more where very many edges lie in one place.
  std::size_t close(const Surface&, const std::vector<SurfaceEdge>&, double tolerance);

 private:
  struct OpenEdge {
    std::uint32_t corner;
    double level;
  };
  struct Junction {
    std::uint32_t corner, point;  // of the edge from this corner on
    double at;                    // 0 to 1
  };

  void collect(const Surface&, const std::vector<SurfaceEdge>&);
  void spread_edges(const Surface&);
  void find_edges(const Surface&, std::uint32_t point);
  void test(const Surface&, std::uint32_t corner, std::uint32_t point);
  void insert(const Surface&);
  void interpolate(Attribute&, const Surface&);

  std::vector<OpenEdge> edges_;
  std::vector<std::uint32_t> points_;  // of open edges, each once
  std::vector<char> listed_;           // by point
  std::vector<double> levels_;         // those in use
  CellGrid grid_;
  double near_ = 0, end_ = 0;  // distances: on the edge up to the first, and no end of it from the second
  std::size_t budget_ = 0;
  std::vector<Junction> junctions_;
  std::vector<std::uint32_t> room_, face_begin_;
};

}  // namespace wrlkit

// All triangles that a scene shows, in world coordinates: what can be measured.
#pragma once
#include "base/diagnostics.h"
#include "convert/geometry_census.h"
#include "geometry/closest_point.h"

namespace wrlkit {

class ShownSurface {
 public:
  /// More triangles than this are not gathered: they take some 30 bytes each here, and 100 more while they are
  /// compared.
  static constexpr std::size_t most_triangles = 40'000'000;

  /// The surface of a scene whose prototypes and Inlines are expanded.
  ShownSurface(const Scene& scene, Diagnostics& diag);

  /// Puts the mesh of a geometry, fronts counter-clockwise, wherever that is shown. Once for each geometry; meshes that
  /// are not triangles are passed over.
  void add(NodeId geometry, const Mesh& mesh);

  Triangles triangles() const { return {positions_, corners_}; }
  /// False when there was more than can be gathered, which was reported.
  bool complete() const { return complete_; }

 private:
  void put(const Mesh& mesh, const Matrix& place);
  void give_up(std::size_t limit, std::string_view what);

  Diagnostics& diag_;
  Places places_;
  bool complete_ = true;
  std::vector<double> positions_;
  std::vector<std::uint32_t> corners_;
  StampedMap slot_;  // of a position of the mesh, in positions_
};

}  // namespace wrlkit

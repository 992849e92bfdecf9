// Morph targets: what a CoordinateInterpolator does to the points of a geometry, and a NormalInterpolator to its
// normals.
//
// Each different value among the keys is a target, so far from what the file says as the value is; the weights are 1
// for the key that is reached and 0 for the others. Between two keys they go evenly, as the points do. Where the file
// gives no normals, those of the moved points are made, within the smoothing groups that the points as they stand have;
// between keys they go evenly, which is right at the keys only.
#pragma once
#include <deque>

#include "geometry/vertices.h"
#include "writers/gltf/animations.h"

namespace wrlkit::gltf {

struct Morph {
  struct Target {
    std::uint32_t positions = none, normals = none;
    auto operator<=>(const Target&) const = default;
  };
  std::vector<Target> targets;
  std::vector<Motion::Field> inputs;
  std::map<std::uint32_t, std::vector<std::uint32_t>> of_keys;  // of interpolators; none: as it stands
};

class Morphs {
 public:
  static constexpr std::size_t max_targets = 1000;            // of one geometry
  static constexpr std::uint64_t max_vertices = 100'000'000;  // of all targets

  Morphs(const Scene& scene, const Motion& motion, Store& store, Diagnostics& diag)
      : scene_(scene), motion_(motion), store_(store), diag_(diag) {}

  /// Does anything move its points or normals?
  bool moves(NodeId geometry) const;
  /// Are the normals of the moved points made here?
  bool makes_normals(NodeId geometry) const;
  /// Index into morphs(); none when nothing moves the geometry. The vertices are those of the mesh.
  std::uint32_t add(NodeId geometry, const Mesh&, const SplitScratch&, const Vertices&);
  const Morph& operator[](std::uint32_t i) const { return morphs_[i]; }

  /// What the weights of nodes that show it follow.
  Property weights(std::uint32_t morph, std::vector<std::uint32_t> nodes) const;

 private:
  struct Source;
  bool collect(Morph&, Source&, NodeId node, std::uint16_t slot, bool normals);
  std::uint32_t target(Morph&, Source&, std::span<const double> values, bool normals);
  std::vector<float> normals_at(const Source&, const std::vector<double>& positions) const;

  const Scene& scene_;
  const Motion& motion_;
  Store& store_;
  Diagnostics& diag_;
  std::deque<Morph> morphs_;
  std::uint64_t n_vertices_ = 0;
};

}  // namespace wrlkit::gltf

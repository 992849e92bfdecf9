// A whole scene at falling numbers of triangles that are drawn: one budget for all of its parts.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/simplify/leveled_surface.h"
#include "geometry/simplify/world.h"

namespace wrlkit {

class WorldLevels {
 public:
  /// Cuts the surfaces of a scene (surfaces_of) into connected parts, finds for each what might replace it
  /// (simplify/ladder.h), and shares the triangles out (simplify/allocation.h) at the numbers of triangles that the
  /// options ask for, by `every`, `counts` or `ratios`. Each place of a shared geometry is drawn and counts; all of
  /// them are simplified alike. Of very many places (8 million triangles) some are looked at, spread evenly. Small
  /// parts leave. What stays as it is counts, too; the rest makes up for it with at most half of the triangles that it
  /// would have otherwise. All meshes are in memory. `scene` must outlive this.
  WorldLevels(const Scene& scene, const WorldSimplifyOptions& options, Task& ctx);
  ~WorldLevels();

  /// Triangles of the surfaces in all places that are shown, and each surface once.
  std::size_t n_drawn() const;
  std::size_t n_faces() const;
  /// Whether each surface is in one place.
  bool is_drawn_once() const;
  /// Of a scene that draws more there are no parts and no points.
  static constexpr std::size_t most_drawn = 1'000'000'000'000'000;
  /// Connected pieces of surfaces, each once.
  std::size_t n_parts() const;

  /// An interaction point: triangles as they are drawn, distances over all places, estimated from samples.
  struct Point {
    std::size_t n_drawn = 0, n_faces = 0;
    std::size_t n_gone = 0;  // parts that have left
    double rms = 0, max = 0;
  };
  const std::vector<Point>& points() const;
  /// Texts that are faces at some point, or gone, so that their words are lost.
  std::size_t n_texts_as_faces() const;
  /// The first number of triangles that what stays as it is keeps from being reached.
  std::optional<std::size_t> missed() const;
  /// Reports not-simplified, with the causes, where there is one.
  void report_missed(Diagnostics& diag) const;
  /// The first call makes the meshes of all points, which are kept; not for several threads at a time.
  Scene scene_at(std::size_t i) const;
  static constexpr std::uint32_t as_it_was = 0xffffffffu;
  using UseMesh = std::function<void(std::size_t level, NodeId geometry, Mesh mesh)>;
  /// Levels with each surface at a point of its own, by the number of its geometry node, or as it was. Gives the mesh
  /// of each surface that is not as it was, ordered by surface and then by level; without corners where it is gone.
  void for_each_mesh(std::span<const std::vector<std::uint32_t>> levels, const UseMesh& use) const;
  /// Triangles that are left of each surface, once, by the number of its geometry node.
  std::vector<std::size_t> faces_at(std::size_t i) const;
  /// With LOD nodes that have the points as levels.
  Scene scene_with_levels() const;
  /// The scene, with geometry for each surface at each point that nothing refers to yet: `surfaces` says which. Their
  /// levels are those of the scene and of all points.
  Scene scene_with_surfaces(std::vector<LeveledSurface>& surfaces) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace wrlkit

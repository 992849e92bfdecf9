// The parts of a scene: connected pieces of its surfaces, what may replace each of them, and where they are.
#pragma once
#include <vector>

#include "base/task.h"
#include "geometry/simplify/allocation.h"
#include "geometry/simplify/surface_places.h"

namespace wrlkit::simplify {

/// A surface in the places where it is shown.
struct PlacedSurface {
  ShapeSurface surface;
  Mesh mesh;
  std::uint64_t n_places = 0;    // where it is shown
  std::vector<Matrix> places{};  // all of them to the world, or some of very many
  std::size_t widest = 0;        // of the places: where it is largest
  double scale = 1;              // metres of the world for its unit, there
  std::vector<std::uint32_t> fixed{};
  std::uint32_t look = 0;
  bool is_text = false;
  std::uint32_t first_part = 0, n_parts = 0;

  /// Places that each of `some` stands for.
  double each(std::size_t some) const { return static_cast<double>(n_places) / static_cast<double>(some); }
};

/// A piece of a surface, such as a letter. Pieces of like form have one ladder.
struct WorldPart {
  std::uint32_t surface;
  std::vector<std::uint32_t> faces;
  std::uint32_t ladder = 0;
  Matrix from_ladder;   // from metres where the ladder is to the coordinates of the surface: affine
  double own_area = 0;  // in the coordinates of the surface
  double area = 0;      // in the widest place
};

class WorldParts {
 public:
  /// Of surfaces of `original`, where `scene` shows them: it is the same scene, or has instances of prototypes
  /// expanded.
  WorldParts(const Scene& original, const Scene& scene, const CollapseOptions& options, OfText text, Task& ctx);

  /// Triangles that a scene may draw; of one that draws more there are no parts.
  static constexpr std::uint64_t most_drawn = 1'000'000'000'000'000;

  /// Finds what may replace the parts. O(n log n), on all threads.
  void make_ladders();

  std::uint64_t n_drawn = 0;  // of the surfaces, in all places; saturates
  std::size_t n_faces = 0;    // of the surfaces, once
  std::uint64_t n_left = 0;   // triangles that are drawn of what is left alone; saturates
  std::vector<std::pair<std::string_view, std::uint64_t>> left;  // why, and how many of them
  double area = 0;                                               // in the world
  std::vector<PlacedSurface> surfaces;
  std::vector<WorldPart> parts;
  std::vector<AllocatedPart> allocated;  // of each part
  Neighbours neighbours;

  /// Against other rungs; without any, against the surface as it was.
  bool is_changed(const PlacedSurface& s, const std::vector<std::uint32_t>& rungs,
                  const std::vector<std::uint32_t>* before = nullptr) const;

 private:
  void read(const Scene& original, OfText text, Task& ctx);
  void find_places(const ShownTimes& shown, const std::vector<ShapeSurface>& found);
  bool measure_places(PlacedSurface& s);
  void count_left(const ShownTimes& shown, const std::vector<ShapeSurface>& taken, OfText text, SurfaceReader& reader);
  void leave(std::uint64_t n_triangles, std::string_view why);
  void find_looks();
  void cut();
  Matrix frame_of(const WorldPart& part) const;
  Mesh in_metres(const WorldPart& part, CollapseOptions* options) const;
  struct Known;
  struct Candidate;
  Candidate candidate(std::uint32_t part) const;
  void find_ladder_of(std::uint32_t part, Candidate mine, std::vector<Known>& alike);
  void find_ladders();
  void make_ladder_of(std::uint32_t ladder);
  void find_leaving(std::uint32_t part);
  struct Surroundings;
  bool yields(std::uint32_t owner, std::uint32_t other) const;
  /// `found`: where the sample before was near to, and then this one.
  double enough(const Surroundings& around, const SurfaceSample& sample, double within, Neighbours::Found& found) const;

  const Scene& scene_;
  CollapseOptions options_;
  std::uint32_t n_owners_ = 0;                       // places of parts that are given
  double n_placed_ = 0;                              // places of parts
  std::vector<std::uint32_t> part_of_;               // of each owner
  std::vector<std::vector<std::uint32_t>> members_;  // of each ladder
  std::vector<std::vector<Rung>> ladders_;
};

}  // namespace wrlkit::simplify

// A series of simplified meshes of one mesh, each with its measured distance from it.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/simplify/collapse.h"

namespace wrlkit {

/// A criterion by its name, which criteria.def lists.
struct CriterionName {
  static constexpr std::string_view type = "criterion";
  Criterion value = Criterion::lindstrom_turk;

  bool read(std::string_view text);
  std::string print() const;

  /// Why no criterion of that name can be chosen in this build; empty when one can.
  static std::string fault(std::string_view text);
  /// All names, for people.
  static std::string help();
};
/// Of the criteria that this build has.
std::vector<std::string> criterion_names();

/// A part of a scene is not simplified further than to what a box has, which could replace it.
constexpr std::size_t faces_of_a_box = 12;

struct LevelOptions {
  CollapseOptions collapse;
  std::vector<double> ratios;  // of the triangles of the first mesh, falling; used when `errors` is empty
  std::vector<double> errors;  // largest distances from the first mesh, ascending, in its units
  double min_saving = 0;       // share of the triangles of the level before that a level has to save
};

struct MeshLevel {
  Mesh mesh;
  double rms = 0, error = 0;  // two-sided distance from the first mesh: root of the mean square, and largest
  double normals = 0;         // angle between the normals of both, in radians, in the mean
  double seconds = 0;         // of LevelMaker: processor time of the collapses from the first mesh to this one
};

/// Levels of one mesh by their numbers of triangles, each made from the one before.
class LevelMaker {
 public:
  /// `first` is a mesh of triangles (Mesh::is_triangles); both must outlive this.
  LevelMaker(const Mesh& first, const CollapseOptions& options);

  /// At most `n_faces` triangles, or as few as there can be; nothing when that are no fewer than there were, or none.
  std::optional<MeshLevel> next(std::size_t n_faces);

 private:
  const Mesh& first_;
  const std::optional<Mesh> painted_;
  const CollapseOptions& options_;
  double seconds_;  // first: it has the time from when the collapser is made
  Collapser collapser_;
};

/// The levels behind `first`, which is a mesh of triangles (Mesh::is_triangles). Each is made from the one before, and
/// is coarser than it but farther from the first: one that saves too little, or is no nearer than a coarser one, is
/// left out, and so is one of fewer triangles than a box has. O(n log n) for each error, or once for all ratios.
std::vector<MeshLevel> make_levels(const Mesh& first, const LevelOptions& options);

}  // namespace wrlkit

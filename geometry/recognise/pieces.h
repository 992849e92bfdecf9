// A mesh cut into its connected parts: equal points are one, faces are neighbours along edges that two of them share.
#pragma once
#include <vector>

#include "geometry/mesh.h"
#include "geometry/recognise/piece.h"

namespace wrlkit::recognising {

/// The step in which numbers were written: 0.001 for three decimals, that of single precision for floats; nearly
/// nothing for others. Asks at most some hundred of them.
double step_of(std::span<const double> numbers);

class Pieces {
 public:
  /// `step` 0: found from the positions. The mesh must outlive this.
  Pieces(const Mesh& mesh, double step);

  /// The next part with at least three faces, in the order of their first faces. False: there are no more.
  bool next(Piece& piece);
  /// What the points of the last part are around, in whole steps.
  const Vec3& origin() const { return origin_; }
  /// Faces that are in no part, as they have no area.
  const std::vector<std::uint32_t>& empty_faces() const { return empty_; }

 private:
  void weld();
  void link();
  void pair_up(std::vector<std::uint32_t>& edges);
  Vec3 at(std::uint32_t point) const;
  std::uint32_t end_of(std::uint32_t h) const;
  bool collect(std::uint32_t face);
  void fill(Piece& piece);

  const Mesh& mesh_;
  double step_;
  Vec3 origin_{};
  std::vector<std::uint32_t> first_;                 // by point: index of one of its positions
  std::vector<std::uint32_t> begin_{0}, mesh_face_;  // faces with an area
  std::vector<std::uint32_t> origin_of_, twin_, face_of_, empty_;
  std::vector<char> seen_, flipped_;
  std::vector<std::uint32_t> faces_, local_point_, local_edge_;  // of the part at hand
  std::uint32_t cursor_ = 0;
  bool mixed_ = false;
};

}  // namespace wrlkit::recognising

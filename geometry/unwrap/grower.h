// One chart grows from a seed, triangle by triangle: each is hinged down over the edge to its neighbour, the nearest to
// the seed first, whole planes at once.
//
// Where the surface is developable, triangles fit exactly, and nothing moves any more. Where it is not, a new corner is
// joined to the place that its point has already if that is near; the error is spread over the chart whenever it has
// doubled. A triangle is refused when it would be stretched too much or overlap; it is asked again after the next
// spread.
#pragma once
#include <queue>

#include "geometry/unwrap/front_grid.h"
#include "geometry/unwrap/relax.h"

namespace wrlkit::unwrap {

class Grower {
 public:
  Grower(const Links& links, const UnfoldOptions& options);

  bool taken(std::uint32_t triangle) const { return slot_[triangle] != none; }
  /// The chart around a triangle that is not taken and has an area. Good until the next call.
  const Flattened& grow(std::uint32_t seed);

 private:
  struct Candidate {
    float distance;
    std::uint32_t corner;  // of a triangle of the chart; the neighbour there is meant
    bool operator<(const Candidate& o) const {
      return distance != o.distance ? distance > o.distance : corner > o.corner;
    }
  };

  void advance();
  bool empty_queue();
  void offer_again();
  bool attach(std::uint32_t corner);
  Point2 unfold_corner(std::uint32_t corner, std::uint32_t opposite) const;
  std::uint32_t known_point(std::uint32_t position, Point2 near, double within) const;
  bool fits(std::uint32_t triangle, const Triangle2& t);
  bool clear_of_others(const Triangle2& t);
  void place(std::uint32_t triangle, const std::array<std::uint32_t, 3>& points);
  bool closes(std::uint32_t corner) const;
  void offer(std::uint32_t corner);
  std::uint32_t point_at(std::uint32_t corner) const {
    return chart_.corner_point[3 * std::size_t{slot_[corner / 3]} + corner % 3];
  }
  bool at_rim(std::uint32_t slot) const;

  void keep();
  void take_back();
  void keep_cells_large(double extent);
  void index();
  bool spread();
  bool too_stretched() const;
  bool sound();

  const Links& links_;
  UnfoldOptions options_;
  std::vector<std::uint32_t> slot_;  // of a triangle in its chart
  std::vector<std::uint32_t> of_chart_;
  std::uint32_t n_charts_ = 0;

  Flattened chart_;
  std::vector<std::uint32_t> newest_, newest_chart_;  // of a position: its last point, and in which chart
  std::vector<std::uint32_t> previous_;               // of a point: the one before at the same position
  Point2 center_;
  double area_ = 0, extent_ = 0, cell_ = 0;
  bool distorted_ = false, searching_ = false;
  std::size_t next_spread_ = 0;
  float reach_ = 0;  // distance beyond which the chart does not grow before the next spread
  std::priority_queue<Candidate> queue_;
  std::vector<std::uint32_t> flat_, refused_;
  FrontGrid grid_;
  Relaxer relaxer_;
  std::vector<Point2> kept_;  // places at the time when all was well, and the triangles at that time
  std::size_t n_kept_ = 0;
};

}  // namespace wrlkit::unwrap

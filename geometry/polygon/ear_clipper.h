// Cuts a ring into triangles by cutting off ears: corners whose triangle has nothing of the polygon inside.
//
// Whether a corner is an ear changes only when one of its neighbours is cut off, so with exact signs each corner is
// looked at three times at most, and what may lie in its triangle is found in a tree. Corners wait in a queue; an ear's
// neighbours go to its end, so that ears are cut all around the polygon and triangles do not all meet in one corner.
// Nearly flat corners wait until no other ear is left: that is what keeps corners on a straight edge from becoming
// triangles without area.
//
// Rings that cross themselves come to a point where no corner is an ear. Then less and less is asked of an ear, for one
// cut at a time; once that has meant looking at all corners too often, it stays so. Nor is more than so much effort
// spent on what lies in triangles: tens of thousands of corners at one point, or needles by the million, would take the
// square of that.
#pragma once
#include "geometry/polygon/point_tree.h"
#include "geometry/polygon/ring.h"

namespace wrlkit {

class EarClipper {
 public:
  /// Cuts the ring that `start` is in, which must run anticlockwise; adds the points of each triangle to `corners`.
  /// Repeated points and spikes are cut off without a triangle, and so is what has no area. The ring is used up.
  /// Returns false when it crosses itself.
  bool clip(Rings& rings, std::uint32_t start, std::vector<std::uint32_t>& corners);

 private:
  enum class State : std::uint8_t { idle, ready, deferred, cut };
  /// What is asked of an ear. touching: the boundary may touch the triangle, but have no corner inside. convex: no
  /// matter what is inside.
  enum class Ask : std::uint8_t { everything, touching, convex, nothing };

  void begin(std::uint32_t start);
  void enqueue_all();
  bool next(std::uint32_t& node);
  bool ask_less();
  void try_corner(std::uint32_t node);
  bool is_tip(std::uint32_t node) const;
  bool is_flatter(std::uint32_t node, double part) const;
  bool blocked(std::uint32_t node);
  bool blocks(std::uint32_t node, std::uint32_t other) const;
  void cut_ear(std::uint32_t node);
  void remove(std::uint32_t node);
  void changed(std::uint32_t node);
  void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  Rings* rings_ = nullptr;
  std::vector<std::uint32_t>* corners_ = nullptr;
  PointTree tree_;  // of the nodes; live are those that are not clearly convex, as no others block an ear
  std::vector<State> state_;
  std::vector<std::uint32_t> tips_, ready_, deferred_, round_;  // round_: the deferred ones whose turn it is
  std::size_t next_ready_ = 0, next_round_ = 0;
  std::uint32_t start_ = 0, n_left_ = 0;
  Ask ask_ = Ask::everything;
  std::size_t rescanned_ = 0, effort_ = 0;
  bool in_round_ = false, crossing_ = false;
};

}  // namespace wrlkit

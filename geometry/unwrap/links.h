// How triangles hang together, and the shape of each in its own plane: all that unfolding needs to know of a surface.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/unwrap/rows.h"
#include "geometry/unwrap/unfold.h"
#include "scenegraph/value.h"

namespace wrlkit::unwrap {

constexpr std::uint32_t none = 0xffffffffu;

inline std::uint32_t next_corner(std::uint32_t c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline std::uint32_t previous_corner(std::uint32_t c) { return c % 3 == 0 ? c + 2 : c - 1; }

class Links {
 public:
  Links(const UnfoldInput& in, double crease_angle);

  std::uint32_t n_triangles() const { return static_cast<std::uint32_t>(flat_.size()); }
  std::uint32_t n_positions() const { return n_positions_; }
  std::uint32_t position(std::uint32_t corner) const { return in_.corners[corner]; }

  /// The corner from which the neighbour runs back along the edge from this corner to the next; none where charts are
  /// cut: at borders, creases, other groups, where more than two triangles meet, and where the winding changes.
  std::uint32_t mate(std::uint32_t corner) const { return mate_[corner]; }
  /// Whether the neighbour there lies in the same plane.
  bool flat(std::uint32_t corner) const { return cosine(corner / 3, mate_[corner] / 3) > same_plane; }
  /// The cosine of the angle between the fronts of two triangles; one without a front agrees with any.
  double cosine(std::uint32_t t, std::uint32_t u) const;
  void cut(std::uint32_t corner) {
    mate_[mate_[corner]] = none;
    mate_[corner] = none;
  }

  /// The triangle in its plane: corner 0 at the origin, corner 1 on the x axis, corner 2 above it.
  Triangle2 shape(std::uint32_t t) const { return {Point2{}, {flat_[t].length, 0}, {flat_[t].x, flat_[t].y}}; }
  /// Twice the area. 0: so thin, or so broken, that it has no front.
  double area(std::uint32_t t) const { return solid_[t] ? flat_[t].length * flat_[t].y : 0; }
  bool finite(std::uint32_t t) const { return finite_[t]; }

 private:
  static constexpr double same_plane = 0.99995;  // cosine: 0.01 rad
  struct Flat {
    double length, x, y;
  };
  struct Normal {
    float x, y, z;
  };
  void lay_flat(std::uint32_t t);
  void connect(double crease_angle);
  void join(std::uint32_t a, std::uint32_t b, double crease_cosine);

  UnfoldInput in_;
  std::uint32_t n_positions_;
  std::vector<Flat> flat_;
  std::vector<Normal> normal_;
  std::vector<char> solid_, finite_;
  std::vector<std::uint32_t> mate_;
};

}  // namespace wrlkit::unwrap

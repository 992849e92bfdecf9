// Where the triangles of a scene go: which rung of its ladder each part stands on, so that the distortion of all is
// least for a number of triangles (Shoham, Gersho: Efficient Bit Allocation for an Arbitrary Set of Quantizers, 1988).
#pragma once
#include <optional>
#include <queue>
#include <vector>

#include "geometry/simplify/ladder.h"
#include "geometry/simplify/neighbours.h"

namespace wrlkit::simplify {

/// A point of a part in the world: when the part leaves, it counts as far as from what is nearest then.
struct LeavingSample {
  Vec3 point;
  double weight;         // area
  double least;          // squared distance that it counts at least near to another look: it was seen
  std::uint32_t look;    // of what it was seen on
  std::uint32_t near;    // owner of what is nearest but for the part; ClosestPoint::no_guess: there is nothing
  double distance;       // from there
  double counted = 0;    // squared distance that it counts already
  bool is_asked = true;  // whether `near` is known
};

/// A part of a scene in all its places.
struct AllocatedPart {
  const std::vector<Rung>* rungs = nullptr;
  std::size_t n_places = 0;                     // where it is drawn
  std::uint32_t first_owner = 0, n_owners = 0;  // among the neighbours: all its places, or some of very many
  Stretch stretch;                              // from the ladder to all places
  std::uint32_t look = 0;                       // what is seen of it
  std::vector<LeavingSample> leaving;

  double max(std::size_t rung) const { return stretch.max((*rungs)[rung].distortion); }
};

class Allocation {
 public:
  static constexpr std::uint32_t gone = 0xffffffffu;

  /// `parts` and `neighbours` must outlive this; what leaves is taken from them. `area` is that of the world.
  Allocation(std::vector<AllocatedPart>& parts, Neighbours& neighbours, double area);

  /// Steps down until at most that many triangles are drawn; then up again with what is left of them, to no higher
  /// rungs than before. False when nothing is left to be taken.
  bool run_to(std::size_t n_drawn);

  std::size_t n_drawn() const { return n_drawn_; }
  /// The rung of each part; gone: none.
  std::vector<std::uint32_t> rungs() const;
  /// Of both surfaces, root of the mean square; and the largest.
  double rms() const;
  double max() const { return max_; }
  /// Of each part, where it stands or since it has left: the largest distance.
  std::vector<double> maxima() const;
  std::size_t n_gone() const { return n_gone_; }

 private:
  struct Step {
    double key;
    std::uint32_t part, to;
    bool operator<(const Step& o) const { return key != o.key ? key > o.key : part > o.part; }
  };
  struct Price {
    double squares = 0, max = 0;
    double peak = 0;  // the largest distance as it counts: of what was seen on another look its width at least
  };
  /// A rung of the convex hull, or one that met a number of triangles.
  struct Stop {
    std::uint32_t rung;
    Price price;
  };

  void price_all();
  Step next_of(std::uint32_t part) const;
  double key_of(double slope, double peak) const;
  void list_stops(std::uint32_t part);
  Stop stop_at(std::uint32_t part, std::uint32_t rung) const;
  void price_leaving(std::uint32_t part);
  bool must_ask(const LeavingSample& s) const;
  void ask(std::span<LeavingSample> samples, std::uint32_t part) const;
  bool is_outdated(const Step& step) const;
  void price_next(const Step& first);
  double squared_of(const LeavingSample& s) const;
  void attach(std::uint32_t part, const LeavingSample& s);
  std::uint32_t stop_of(std::uint32_t part, std::uint32_t rung);
  bool step_down_to(std::size_t n_drawn);
  Step last_step(const Step& step, std::size_t n_drawn);
  void take(const Step& step);
  void leave(std::uint32_t part);
  /// A step up, and how much less each triangle costs then.
  struct Raise {
    double gain;
    std::uint32_t part, rung;
    bool operator<(const Raise& o) const { return gain != o.gain ? gain < o.gain : part > o.part; }
  };
  std::optional<Raise> raise_of(std::uint32_t part, std::uint32_t highest, std::size_t n_spare) const;
  void give_back(std::size_t n_spare, const std::vector<std::uint32_t>& highest);

  std::vector<AllocatedPart>& parts_;
  Neighbours& neighbours_;
  double area_;
  std::vector<std::uint32_t> part_of_;  // of each owner
  std::vector<std::uint32_t> at_;
  std::vector<std::vector<Stop>> stops_;
  std::vector<Price> leaving_;            // as it was when it was asked last
  std::vector<std::uint32_t> n_orphans_;  // behind the part's own samples: of parts that have left, near to it now
  std::priority_queue<Step> queue_;
  std::size_t n_drawn_ = 0, n_gone_ = 0;
  double squares_ = 0, max_ = 0;
  double priced_at_ = 1;  // root of the mean square that the keys are of
};

}  // namespace wrlkit::simplify

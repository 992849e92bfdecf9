// Where the triangles of a world go: which rung of its ladder each part stands on, so that the distortion of all is
// least for a number of triangles (Shoham, Gersho: Efficient Bit Allocation for an Arbitrary Set of Quantizers, 1988).
#pragma once
#include <queue>
#include <vector>

#include "geometry/simplify/ladder.h"
#include "geometry/simplify/neighbours.h"

namespace wrlkit::simplify {

/// A point of a part in the world: when the part leaves, it counts as far as from what is nearest then.
struct LeavingSample {
  Vec3 point;
  double weight;  // area
  double least;   // squared distance that it counts at least near to another look: it was seen
};

/// A part of a world in all its places.
struct AllocatedPart {
  const std::vector<Rung>* rungs = nullptr;
  std::vector<std::uint32_t> places;  // owners among the neighbours
  double weight = 1;                  // of the distortion: over all places, those of the ladder counting 1
  std::uint32_t look = 0;             // what is seen of it
  std::vector<LeavingSample> leaving;
};

class Allocation {
 public:
  static constexpr std::uint32_t gone = 0xffffffffu;

  /// `parts` and `neighbours` must outlive this. `area` is that of the world.
  Allocation(const std::vector<AllocatedPart>& parts, const Neighbours& neighbours, double area);

  /// Steps down until at most so many triangles are drawn. False when nothing is left to be taken.
  bool run_to(std::size_t n_drawn);

  std::size_t n_drawn() const { return n_drawn_; }
  /// The rung of each part; gone: none.
  const std::vector<std::uint32_t>& rungs() const { return at_; }
  /// Of both surfaces, root of the mean square; and the largest.
  double rms() const;
  double max() const { return max_; }
  std::size_t n_gone() const { return n_gone_; }

 private:
  struct Step {
    double key;
    std::uint32_t part, to;
    bool operator<(const Step& o) const { return key != o.key ? key > o.key : part > o.part; }
  };
  /// A point of a part that has left, and what it is near to now.
  struct Orphan {
    LeavingSample sample;
    std::uint32_t look;
    double squared;
  };
  struct Price {
    double squares = 0, max = 0;
  };

  void price_all();
  Step next_of(std::uint32_t part);
  double key_of(double slope, double max) const;
  /// `near`: the parts that it would then be near to.
  Price price_of_leaving(std::uint32_t part, std::vector<std::uint32_t>& near) const;
  void price_leaving(std::uint32_t part);
  void depend(std::uint32_t part, std::vector<std::uint32_t>& near);
  Neighbours::Found nearest_left(const Vec3& p, std::uint32_t without) const;
  double squared_of(const LeavingSample& s, std::uint32_t look, const Neighbours::Found& found) const;
  void take(const Step& step);
  void leave(std::uint32_t part);

  const std::vector<AllocatedPart>& parts_;
  const Neighbours& neighbours_;
  double area_;
  std::vector<std::uint32_t> part_of_;  // of each owner
  std::vector<std::uint32_t> at_;
  std::vector<std::vector<std::size_t>> hull_;
  std::vector<Price> leaving_;                          // as it was when it was asked last
  std::vector<char> outdated_;                          // whether something has left since that matters to it
  std::vector<std::vector<std::uint32_t>> dependents_;  // parts whose leaving was priced by being near to this one
  std::vector<std::vector<Orphan>> orphans_;            // by the part that they are near to
  std::priority_queue<Step> queue_;
  std::size_t n_drawn_ = 0, n_gone_ = 0;
  double squares_ = 0, max_ = 0;
  double priced_at_ = 1;  // root of the mean square that the keys are of
};

}  // namespace wrlkit::simplify

// Where particles begin, and how fast (ISO/IEC 19775-1, clause 40.4).
#pragma once
#include <vector>

#include "base/math/random.h"
#include "base/math/vec.h"
#include "passes/pipeline/pass.h"

namespace wrlkit::x3d {

struct ParticleStart {
  Vec3 position{0, 0, 0}, velocity{0, 0, 0};
  double mass = 0, surface_area = 0;  // kg, square metres
};

class ParticleEmitter {
 public:
  ParticleEmitter(Scene&, NodeId emitter, PassContext&);

  /// False: it is switched off, of an unknown kind, or has nothing to emit from.
  bool any() const { return any_; }
  /// All particles begin at once.
  bool is_explosion() const { return is_explosion_; }
  ParticleStart start(RandomStream&) const;
  /// `value`, by up to that part of it more or less.
  static double varied(double value, double variation, RandomStream&);

 private:
  struct Piece {
    Vec3 a, b, c;  // of a line the first two
    double until;  // sum of the sizes up to here
  };

  template <class Keys>
  void read_common(Keys keys);
  void take_lines();
  void take_faces(NodeId geometry);
  void take_volume();
  void add(const Piece&, double size);
  const Piece& piece(RandomStream&) const;
  Vec3 inside(RandomStream&) const;
  bool is_inside(const Vec3&) const;

  Scene& scene_;
  NodeId n_;
  PassContext& ctx_;
  Vec3 position_{0, 0, 0}, direction_{0, 0, 0};
  double speed_ = 0, variation_ = 0, mass_ = 0, surface_area_ = 0, angle_ = 0;
  std::vector<Piece> pieces_;
  Vec3 low_{0, 0, 0}, high_{0, 0, 0};
  bool any_ = false, is_explosion_ = false, is_volume_ = false, along_normal_ = false;
};

}  // namespace wrlkit::x3d

// Light that comes straight from where it is made: rays to lamps and emitters (next event estimation).
#pragma once
#include "passes/light/emitter_tree.h"
#include "passes/light/flux.h"
#include "passes/light/random.h"
#include "passes/light/world.h"

namespace wrlkit::light {

class DirectLight {
 public:
  explicit DirectLight(const LightWorld& world) : world_(world), tree_(world.emitters()) {}

  /// Adds the irradiance of all lamps that reach there. Up to `most` rays: the strongest lamps get one each; of the others,
  /// when there are more, some are drawn for all.
  void lamps(const Receiver& at, int most, Stream& random, Flux& to) const;

  /// Adds the irradiance of `n` places on emitters, from number `first` of a lattice on, n times as much as it is.
  /// It is a share only: rays in cosine directions find the rest; see gather_weight().
  void emitters(const Receiver& at, const Lattice<3>& places, std::uint32_t first, std::uint32_t n, Flux& to) const;

  /// A ray in a cosine direction met an emitter: the share of its light that counts beside emitters() (the balance
  /// heuristic of Veach and Guibas). 1 when the triangle is no emitter.
  double gather_weight(const Receiver& from, const Ray& ray, const Hit& hit) const;

 private:
  void emitter(const Receiver& at, const EmitterTree::Choice& choice, double u, double v, Flux& to) const;

  const LightWorld& world_;
  EmitterTree tree_;
};

}  // namespace wrlkit::light

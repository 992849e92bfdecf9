// Light that comes straight from where it is made: rays to lamps and emitters (next event estimation).
#pragma once
#include <optional>

#include "base/math/random.h"
#include "light/emitter_tree.h"
#include "light/flux.h"
#include "light/world.h"

namespace wrlkit::light {

class DirectLight {
 public:
  explicit DirectLight(const LightWorld& world) : world_(world), tree_(world.emitters()) {}

  /// Adds the irradiance of all lamps that reach there. Up to `most` rays: the strongest lamps get one each; of the
  /// others, when there are more, some are drawn for all.
  void lamps(const Receiver& at, int most, RandomStream& random, Flux& to) const;

  /// Adds the irradiance of `n` places on emitters, from number `first` of a lattice on, n times as much as it is.
  /// It is a share only: rays in cosine directions find the rest; see gather_weight().
  void emitters(const Receiver& at, const Lattice<3>& places, std::uint32_t first, std::uint32_t n, Flux& to) const;

  /// There are so few emitters that all_emitters() can look at each.
  bool has_few_emitters() const { return !tree_.empty() && world_.emitters().size() <= few; }

  bool is_emitter(const Hit& hit) const { return world_.emitter_of(hit.use, hit.element).has_value(); }

  /// Adds `n` times the irradiance of all emitters, so that no other ray has to find them: of each what it would give
  /// if nothing stood between, exactly, times the share of it that some `n` rays find open (a ratio estimator; Heitz,
  /// Hill and McGuire 2018). Where all or nothing is seen there is no noise. `noise` gets the variance of what was
  /// added. `first` rays by the same key were asked for before: these go on with the same lattices.
  void all_emitters(const Receiver& at, std::uint64_t key, std::uint32_t first, std::uint32_t n, Flux& to,
                    V3& noise) const;

  /// A ray in a cosine direction met an emitter: the share of its light that counts next to emitters() (the balance
  /// heuristic of Veach and Guibas). 1 when the triangle is no emitter.
  double gather_weight(const Receiver& from, const Ray& ray, const Hit& hit) const;

 private:
  static constexpr std::size_t few = 64;

  /// A place on an emitter as a receiver sees it.
  struct Sight {
    Ray ray;
    double arriving, leaving;    // cosine there; cosine * distance * twice the area at the emitter
    double distance2, distance;  // of the place itself
    double through;              // of its light
  };
  std::optional<Sight> look(const Receiver& at, const Emitter& e, double b1, double b2) const;
  V3 add_seen(const Receiver& at, const Emitter& e, const V3& strength, const Lattice<2>& places, std::uint32_t first,
              std::uint32_t n, Flux& to, V3& noise) const;
  void emitter(const Receiver& at, const EmitterTree::Choice& choice, double u, double v, Flux& to) const;

  const LightWorld& world_;
  EmitterTree tree_;
};

}  // namespace wrlkit::light

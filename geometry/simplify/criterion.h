// A criterion prices the edges of one vertex. Each is a class in a source of its own;
// criteria.def lists them.
#pragma once
#include <memory>
#include <vector>

#include "geometry/simplify/collapse.h"
#include "geometry/simplify/surface.h"
#include "geometry/simplify/wedges.h"

namespace wrlkit::simplify {

/// Where the vertex of an edge may go.
enum class Placement { nowhere, center, spoke, anywhere };

/// The edge from the centre of a ring to one of its spokes, what its collapse costs and where its vertex goes.
struct Option {
  int spoke;
  double cost;  // not negative; infinite: only when nothing else is left
  Vec3 position;
  Placement where = Placement::anywhere;
};

class Pricer {
 public:
  static constexpr int every = -1, own = -2;

  explicit Pricer(const Surface& surface) : surface_(surface) {}
  virtual ~Pricer() = default;

  /// Adds the options of the ring's centre: of every spoke, of those whose other end will not offer the edge (own), or
  /// of one. Collapses across a crease are made dearer.
  void price(const Ring& ring, int spokes, std::vector<Option>& options);
  /// Adds the two options of an edge whose vertex may go anywhere to be at one of its ends.
  void price_ends(const Ring& ring, int spoke, std::vector<Option>& options);

  /// Whether an edge has a cost of its own in each direction, goes from the centre to the spoke only, and is an option
  /// of both ends.
  virtual bool one_way() const { return false; }
  /// Before the faces and wedges of the two rings change; the vertex that is left will be at `x`.
  virtual void before_merge(const Ring& /*from*/, const Ring& /*to*/, const Vec3& /*x*/) {}
  /// After it, with the same rings: those of their faces that are alive belong to the centre of `to`.
  virtual void after_merge(const Ring& /*from*/, const Ring& /*to*/) {}

 private:
  Option placed(const Ring& ring, int spoke, Placement where) const;

 protected:
  /// Called for a ring before option is, for every spoke or for one.
  virtual void prepare(const Ring&, int /*spokes*/) {}
  virtual Option option(const Ring& ring, int spoke, Placement where) const = 0;

  const Surface& surface_;
};

std::unique_ptr<Pricer> make_pricer(Criterion criterion, const Surface& surface, const Wedges& wedges);
#define PRICER(name) std::unique_ptr<Pricer> name(const Surface& surface, const Wedges& wedges);
#define SIMPLIFIER(name)
#include "geometry/simplify/criteria.def"

}  // namespace wrlkit::simplify

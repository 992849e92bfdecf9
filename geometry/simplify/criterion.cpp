#include "geometry/simplify/criterion.h"

namespace wrlkit::simplify {

namespace {

constexpr double crease_factor = 4;  // what a collapse across a crease costs more

Placement placement(Kind center, Kind spoke, bool feature) {
  if (center == Kind::fixed && spoke == Kind::fixed) return Placement::nowhere;
  if (feature) {
    if (center == spoke) return Placement::anywhere;
    return center > spoke ? Placement::center : Placement::spoke;  // line < corner < fixed
  }
  if (center == Kind::free && spoke == Kind::free) return Placement::anywhere;
  if (center == Kind::free) return Placement::spoke;
  return spoke == Kind::free ? Placement::center : Placement::nowhere;
}

}  // namespace

void Pricer::price(const Ring& ring, int spokes, std::vector<Option>& options) {
  prepare(ring, spokes);
  const Surface::Vertex& u = surface_.vertex[ring.center];
  for (int i = 0; i < ring.n_spokes; ++i) {
    const Ring::Spoke& s = ring.spokes[i];
    const Surface::Vertex& v = surface_.vertex[s.vertex];
    if (spokes >= 0 && i != spokes) continue;
    if (spokes == own && !one_way() && s.vertex < ring.center && v.degree <= Ring::max_faces) continue;
    const Placement where = placement(u.kind, v.kind, s.feature);
    if (where == Placement::nowhere || (one_way() && where == Placement::center)) continue;
    options.push_back(placed(ring, i, where));
  }
}

void Pricer::price_ends(const Ring& ring, int spoke, std::vector<Option>& options) {
  prepare(ring, spoke);
  for (Placement where : {Placement::center, Placement::spoke}) options.push_back(placed(ring, spoke, where));
}

Option Pricer::placed(const Ring& ring, int spoke, Placement where) const {
  const Ring::Spoke& s = ring.spokes[spoke];
  const Surface::Vertex &u = surface_.vertex[ring.center], &v = surface_.vertex[s.vertex];
  Option o = option(ring, spoke, where);
  o.where = where;
  if (where == Placement::center) o.position = u.position;  // exactly
  if (where == Placement::spoke) o.position = v.position;
  const Placement along_creases = placement(u.crease_kind, v.crease_kind, s.feature || s.crease);
  if (along_creases != where && along_creases != Placement::anywhere) o.cost *= crease_factor;
  return o;
}

std::unique_ptr<Pricer> make_pricer(Criterion criterion, const Surface& surface, const Wedges& wedges) {
  switch (criterion) {
#define PRICER(name)    \
  case Criterion::name: \
    return name(surface, wedges);
#define SIMPLIFIER(name) case Criterion::name:
#include "geometry/simplify/criteria.def"
    break;
  }
  return nullptr;
}

}  // namespace wrlkit::simplify

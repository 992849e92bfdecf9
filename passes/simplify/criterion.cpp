#include "passes/simplify/criterion.h"

namespace wrlkit::simplify {

namespace {

constexpr double crease_factor = 4;

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

Terms terms(const Surface& surface, const Ring& ring, int spoke) {
  const Ring::Spoke& s = ring.spokes[spoke];
  std::uint32_t u = ring.center, v = s.vertex;
  Placement where = placement(surface.vertex[u].kind, surface.vertex[v].kind, s.feature);
  Placement along = placement(surface.vertex[u].crease_kind, surface.vertex[v].crease_kind, s.feature || s.crease);
  return {where, where == along ? 1 : crease_factor};
}

std::unique_ptr<Pricer> make_pricer(Criterion criterion, const Surface& surface, const Wedges& wedges) {
  switch (criterion) {
    case Criterion::length_normal: return length_normal(surface);
    case Criterion::melax: return melax(surface);
    case Criterion::lindstrom_turk: return lindstrom_turk(surface);
    case Criterion::quadric: return quadric(surface, wedges);
    case Criterion::meshopt: break;
  }
  return nullptr;
}

}  // namespace wrlkit::simplify

#include "geometry/simplify/simplifier.h"

#include <algorithm>

#include "geometry/simplify/engine.h"

namespace wrlkit {
namespace {

CriterionInfo described(std::string name, bool keeps_record, std::string_view missing) {
  std::ranges::replace(name, '_', '-');
  return {std::move(name), keeps_record, missing};
}

constexpr Criterion listed[] = {
#define PRICER(name) Criterion::name,
#define SIMPLIFIER(name) Criterion::name,
#include "geometry/simplify/criteria.def"
};

}  // namespace

std::span<const Criterion> all_criteria() { return listed; }

const CriterionInfo& info(Criterion criterion) {
  static const CriterionInfo infos[] = {
#define PRICER(name) described(#name, true, {}),
#define SIMPLIFIER(name) described(#name, false, simplify::name.missing),
#include "geometry/simplify/criteria.def"
  };
  return infos[static_cast<std::size_t>(criterion)];
}

}  // namespace wrlkit

namespace wrlkit::simplify {

void Simplifier::write(Mesh& mesh) const {
  std::vector<std::uint32_t> id(surface_.n_vertices(), none);
  auto& positions = mesh.positions.edit();
  for (std::uint32_t f = 0; f < surface_.n_slots(); ++f) {
    if (!surface_.alive(f)) continue;
    for (std::uint32_t v : surface_.face[f].v) {
      if (id[v] == none) {
        id[v] = static_cast<std::uint32_t>(positions.size() / 3);
        const Vec3& p = surface_.position(v);
        positions.insert(positions.end(), p.begin(), p.end());
      }
      mesh.corners.push_back(id[v]);
    }
  }
  wedges_.write(mesh, surface_);
}

std::unique_ptr<Simplifier> make_simplifier(const Mesh& mesh, const CollapseOptions& options) {
  switch (options.criterion) {
#define PRICER(name) case Criterion::name:
#define SIMPLIFIER(name)
#include "geometry/simplify/criteria.def"
    break;
#define PRICER(name)
#define SIMPLIFIER(name) \
  case Criterion::name:  \
    return name.make(mesh, options);
#include "geometry/simplify/criteria.def"
  }
  return std::make_unique<Engine>(mesh, options);
}

}  // namespace wrlkit::simplify

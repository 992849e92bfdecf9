#include "parsers/gltf/bounds.h"

#include <algorithm>
#include <limits>
#include <set>

#include "parsers/gltf/trs.h"

namespace wrlkit::gltf_reader {

Ball bounds_below(File& file, std::uint32_t node) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};
  std::set<std::uint64_t> seen;
  std::vector<std::pair<std::uint64_t, Matrix>> open{{node, Matrix()}};
  while (!open.empty()) {
    auto [n, frame] = open.back();
    open.pop_back();
    const Json json = file.at(Table::nodes, n);
    if (!json || !seen.insert(n).second) continue;
    const Matrix m = frame * place_of(json).matrix();
    for (Json c : json["children"].elements()) open.emplace_back(c.whole().value_or(none), m);
    for (Json p : file.at(Table::meshes, json["mesh"].whole().value_or(none))["primitives"].elements()) {
      const Json a = file.at(Table::accessors, p["attributes"]["POSITION"].whole().value_or(none));
      auto from = a["min"].numbers(), to = a["max"].numbers();
      if (from.size() != 3 || to.size() != 3) continue;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 q =
            m.point({corner & 1 ? from[0] : to[0], corner & 2 ? from[1] : to[1], corner & 4 ? from[2] : to[2]});
        for (std::size_t i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], q[i]);
          high[i] = std::max(high[i], q[i]);
        }
      }
    }
  }
  Ball b;
  if (!(low[0] <= high[0])) return b;
  for (std::size_t i = 0; i < 3; ++i) b.center[i] = (low[i] + high[i]) / 2;
  b.radius = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2;
  return b;
}

}  // namespace wrlkit::gltf_reader

#include "parsers/gltf/bounds.h"

#include <algorithm>
#include <limits>
#include <set>

#include "base/math/box.h"
#include "parsers/gltf/trs.h"

namespace wrlkit::gltf_reader {

Ball bounds_below(File& file, std::uint32_t node) {
  Box box;
  std::set<std::uint64_t> seen;
  std::vector<std::pair<std::uint64_t, Matrix>> open{{node, Matrix()}};
  while (!open.empty()) {
    auto [n, frame] = open.back();
    open.pop_back();
    const Json json = file.at(Table::nodes, n);
    if (!json || !seen.insert(n).second) continue;
    const Matrix m = frame * matrix_of(place_of(json));
    for (Json c : json["children"].elements()) open.emplace_back(c.whole().value_or(none), m);
    for (Json p : file.at(Table::meshes, json["mesh"].whole().value_or(none))["primitives"].elements()) {
      const Json a = file.at(Table::accessors, p["attributes"]["POSITION"].whole().value_or(none));
      auto from = a["min"].numbers(), to = a["max"].numbers();
      if (from.size() != 3 || to.size() != 3) continue;
      const Box own{vec3(from.data()), vec3(to.data())};
      for (int corner = 0; corner < 8; ++corner) box.add(m.point(own.corner(corner)));
    }
  }
  return box.empty() ? Ball{} : Ball{box.centre(), diagonal(box) / 2};
}

}  // namespace wrlkit::gltf_reader

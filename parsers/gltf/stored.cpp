#include "parsers/gltf/stored.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "parsers/gltf/file.h"
#include "parsers/gltf/visibility.h"

namespace wrlkit {
namespace gltf_reader {
namespace {

constexpr std::uint64_t mode_triangles = 4, mode_fan = 6;  // values of mode; a strip is between them

/// An index without a message: who shows the mesh has reported it.
std::uint32_t index_of(const File& file, Table table, Json reference) {
  const auto i = reference.whole();
  return i && *i < file.count(table) ? static_cast<std::uint32_t>(*i) : none;
}

/// Meshes that the nodes of the default scene show; of a file without scenes, those of all nodes.
std::set<std::uint32_t> shown_meshes(const File& file) {
  std::set<std::uint32_t> out;
  std::vector<std::uint32_t> open;
  const auto open_all = [&](Json list) {
    for (const Json n : list.elements()) open.push_back(index_of(file, Table::nodes, n));
  };
  if (file.count(Table::scenes) > 0)
    open_all(file.at(Table::scenes, file.root()["scene"].whole().value_or(0))["nodes"]);
  else
    for (std::uint32_t n = 0; n < file.count(Table::nodes); ++n) open.push_back(n);
  std::vector<char> seen(file.count(Table::nodes));
  while (!open.empty()) {
    const auto n = open.back();
    open.pop_back();
    if (n == none || seen[n]) continue;
    seen[n] = 1;
    const Json node = file.at(Table::nodes, n);
    if (is_hidden(node)) continue;
    out.insert(index_of(file, Table::meshes, node["mesh"]));
    open_all(node["children"]);
  }
  out.erase(none);
  return out;
}

}  // namespace
}  // namespace gltf_reader

std::uint64_t stored_triangles(std::string_view gltf) {
  using namespace gltf_reader;
  Diagnostics unseen;
  File file(gltf, 0, unseen);
  if (!file.read()) return 0;
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>> known;
  std::uint64_t sum = 0;
  for (const auto mesh : shown_meshes(file))
    for (const Json p : file.at(Table::meshes, mesh)["primitives"].elements()) {
      const auto mode = p["mode"] ? p["mode"].whole().value_or(0) : mode_triangles;
      const auto indices = index_of(file, Table::accessors, p["indices"]);
      const auto points = index_of(file, Table::accessors, p["attributes"]["POSITION"]);
      if (mode < mode_triangles || mode > mode_fan || !known.insert({indices, points, mode}).second) continue;
      const Json accessor = file.at(Table::accessors, indices == none ? points : indices);
      const auto corners = accessor["count"].whole().value_or(0);
      sum += mode == mode_triangles ? corners / 3 : std::max<std::uint64_t>(corners, 2) - 2;
    }
  return sum;
}

}  // namespace wrlkit

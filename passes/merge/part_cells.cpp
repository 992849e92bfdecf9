#include "passes/merge/part_cells.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "passes/merge/gltf_cost.h"

namespace wrlkit {
namespace {

struct Copies {
  std::vector<std::uint32_t> items;
  double saved = 0;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> part_cells(std::span<const PartItem> items) {
  std::unordered_map<std::uint32_t, std::uint32_t> group_of_shape, uses;
  constexpr std::uint32_t several = 0xffffffff;
  for (const PartItem& i : items) {
    const auto [at, is_new] = group_of_shape.try_emplace(i.shape, i.group);
    if (!is_new && at->second != i.group) at->second = several;
    ++uses[i.geometry];
  }
  std::map<std::uint32_t, std::map<std::uint32_t, Copies>> groups;
  for (std::uint32_t n = 0; n < items.size(); ++n)
    if (group_of_shape[items[n].shape] != several) groups[items[n].group][items[n].geometry].items.push_back(n);
  std::vector<std::vector<std::uint32_t>> out;
  for (auto& [group, geometries] : groups) {
    std::vector<std::uint32_t> cell;
    double saved = 0;
    for (auto& [geometry, copies] : geometries) {
      const PartItem& one = items[copies.items[0]];
      const double n = static_cast<double>(copies.items.size());
      const bool all = uses[geometry] == copies.items.size();
      copies.saved = n * one.times * gltf_cost::node + (all ? gltf_cost::mesh + gltf_cost::own_share * one.bytes : 0) -
                     n * one.bytes;
      if (copies.saved <= 0) continue;
      saved += copies.saved;
      cell.insert(cell.end(), copies.items.begin(), copies.items.end());
    }
    if (cell.size() < 2 || saved <= gltf_cost::mesh + gltf_cost::node * items[cell[0]].times) continue;
    std::ranges::sort(cell);
    out.push_back(std::move(cell));
  }
  return out;
}

}  // namespace wrlkit

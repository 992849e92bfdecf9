#include "passes/join/touching.h"

#include <algorithm>
#include <bit>

#include "base/hashing.h"

namespace wrlkit {

std::size_t Touching::PointHash::operator()(const Point& p) const {
  std::uint64_t h = 0;
  for (const double v : p) h = mixed(h, std::bit_cast<std::uint64_t>(v + 0.0));  // -0 is 0
  return h;
}

void Touching::add(std::span<const double> positions, std::span<const std::uint32_t> corners) {
  const auto thing = static_cast<std::uint32_t>(joined_to_.size());
  joined_to_.push_back(thing);
  for (const auto corner : corners) {
    const auto at = std::size_t{corner} * 3;
    const auto owner = owner_.try_emplace({positions[at], positions[at + 1], positions[at + 2]}, thing).first->second;
    const auto a = first_of(owner), b = first_of(thing);
    if (a != b) joined_to_[std::max(a, b)] = std::min(a, b);
  }
}

std::uint32_t Touching::first_of(std::uint32_t thing) {
  while (joined_to_[thing] != thing) thing = joined_to_[thing] = joined_to_[joined_to_[thing]];
  return thing;
}

std::vector<std::vector<std::size_t>> Touching::groups() {
  std::vector<std::vector<std::size_t>> out;
  std::vector<std::size_t> group_of(joined_to_.size());
  for (std::uint32_t thing = 0; thing < joined_to_.size(); ++thing) {
    const auto first = first_of(thing);
    if (first == thing) {
      group_of[thing] = out.size();
      out.emplace_back();
    }
    out[group_of[first]].push_back(thing);
  }
  return out;
}

}  // namespace wrlkit

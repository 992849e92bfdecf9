#include "writers/gltf/parts.h"

#include <algorithm>
#include <utility>

namespace wrlkit::gltf {
namespace {

/// Little-endian, of two bytes or four.
Column column(const std::vector<std::uint32_t>& values, bool wide) {
  Column out{.stride = static_cast<std::uint8_t>(wide ? 4 : 0)};
  for (std::uint32_t v : values)
    for (std::size_t i = 0; i < (wide ? 4u : 2u); ++i) out.bytes += static_cast<char>(v >> 8 * i & 0xff);
  return out;
}

}  // namespace

std::uint32_t PartTable::find_or_add(std::string_view name, std::uint32_t parent) {
  const auto [at, is_new] = known_.try_emplace({parent, std::string(name)}, static_cast<std::uint32_t>(rows_.size()));
  if (is_new) rows_.push_back({std::string(name), parent});
  return at->second;
}

std::uint32_t PartTable::of_path(std::string_view path) {
  std::uint32_t parent = none;
  if (!columns_) return find_or_add(path, none);
  if (path.empty()) return find_or_add("#1", none);  // merge calls the next ones without a name "#2", "#3"
  for (auto slash = path.find('/'); slash != path.npos; slash = path.find('/')) {
    parent = find_or_add(path.substr(0, slash), parent);
    path.remove_prefix(slash + 1);
  }
  return find_or_add(path, parent);
}

std::uint32_t PartTable::add(std::string_view name, std::uint32_t parent) {
  const std::uint32_t first = find_or_add(name, parent);
  if (!std::exchange(rows_[first].claimed, true)) return first;
  rows_.push_back({std::string(name), parent, true});
  return static_cast<std::uint32_t>(rows_.size() - 1);
}

Column PartTable::texts() const {
  Column out;
  for (const Row& r : rows_) out.bytes += r.name;
  return out;
}

Column PartTable::offsets(bool packed) const {
  std::vector<std::uint32_t> all{0};
  for (const Row& r : rows_) all.push_back(all.back() + static_cast<std::uint32_t>(r.name.size()));
  return column(all, packed || all.back() > 65535);
}

Column PartTable::parents(bool packed) const {
  std::vector<std::uint32_t> all;
  const auto nothing = no_parent(packed, rows_.size());
  for (const Row& r : rows_) all.push_back(r.parent == none ? nothing : r.parent);
  return column(all, nothing == none);
}

bool PartTable::any_parent() const {
  return std::ranges::any_of(rows_, [](const Row& r) { return r.parent != none; });
}

}  // namespace wrlkit::gltf

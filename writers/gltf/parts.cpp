#include "writers/gltf/parts.h"

#include <algorithm>
#include <utility>

#include "scenegraph/places/name_path.h"

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
  if (is_new) rows_.push_back({std::string(name), parent, false, parent == none ? none : rows_[parent].source});
  return at->second;
}

std::uint32_t PartTable::of_path(std::string_view path) {
  std::uint32_t parent = none;
  if (!columns_) return find_or_add(path, none);     // paths are read as such
  if (path.empty()) return find_or_add("#1", none);  // merge calls the next ones without a name "#2", "#3"
  for (const auto step : path_steps(path)) {
    parent = find_or_add(name_of_step(step), parent);
    const auto here = path.substr(0, static_cast<std::size_t>(step.data() + step.size() - path.data()));
    const auto source = std::ranges::lower_bound(sources_, here);
    if (source != sources_.end() && *source == here)
      rows_[parent].source = static_cast<std::uint32_t>(source - sources_.begin());
  }
  return parent;
}

std::uint32_t PartTable::add(std::string_view name, std::uint32_t parent) {
  const std::uint32_t first = find_or_add(name, parent);
  if (!std::exchange(rows_[first].claimed, true)) return first;
  rows_.push_back({std::string(name), parent, true, rows_[first].source});
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

Column PartTable::row_sources() const {
  std::vector<std::uint32_t> all;
  for (const Row& r : rows_) all.push_back(std::min(r.source, no_source));
  return column(all, false);
}

bool PartTable::any_without_source() const {
  return std::ranges::any_of(rows_, [](const Row& r) { return r.source >= no_source; });
}

bool PartTable::has_parents() const {
  return !sources_.empty() || std::ranges::any_of(rows_, [](const Row& r) { return r.parent != none; });
}

}  // namespace wrlkit::gltf

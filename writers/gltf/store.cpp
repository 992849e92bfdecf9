#include "writers/gltf/store.h"

#include <functional>

namespace wrlkit::gltf {
namespace {

constexpr std::uint16_t byte = 5120, short_ = 5122, unsigned_short = 5123, unsigned_int = 5125, float_ = 5126;
// 65535 would start a new primitive in some graphics libraries, so glTF does not allow it as an index.
constexpr std::size_t max_vertices_16 = 65535;

}  // namespace

const ViewInfo& info(View v) {
  using enum Filter;
  constexpr bool yes = true, no = false;
  static constexpr ViewInfo table[n_views] = {{12, float_, yes, no, no, "VEC3", none, "positions"},
                                              {12, float_, yes, no, no, "VEC3", none, "normals"},
                                              {12, float_, yes, no, no, "VEC3", none, "colors"},
                                              {16, float_, yes, no, no, "VEC4", none, "colors"},
                                              {8, float_, yes, no, no, "VEC2", none, "texcoords"},
                                              {2, unsigned_short, no, yes, no, "SCALAR", none, "indices"},
                                              {4, unsigned_int, no, yes, no, "SCALAR", none, "indices"},
                                              {4, float_, no, no, no, "SCALAR", none, "animation"},
                                              {4, float_, no, no, no, "SCALAR", none, "animation"},
                                              {8, float_, no, no, no, "VEC2", none, "animation"},
                                              {12, float_, no, no, no, "VEC3", none, "places"},
                                              {16, float_, no, no, no, "VEC4", none, "places"},
                                              {8, short_, yes, no, no, "VEC3", none, "positions"},
                                              {4, byte, yes, no, yes, "VEC3", none, "normals"},
                                              {8, unsigned_short, yes, no, yes, "VEC3", none, "colors"},
                                              {8, unsigned_short, yes, no, yes, "VEC4", none, "colors"},
                                              {4, unsigned_short, yes, no, yes, "VEC2", none, "texcoords"},
                                              {12, float_, yes, no, no, "VEC3", exponential, "positions"},
                                              {4, byte, yes, no, yes, "VEC3", octahedral, "normals"},
                                              {8, float_, yes, no, no, "VEC2", exponential, "texcoords"},
                                              {2, unsigned_short, no, yes, no, "SCALAR", none, "indices"},
                                              {4, unsigned_int, no, yes, no, "SCALAR", none, "indices"},
                                              {4, float_, yes, no, no, "SCALAR", none, "features"},
                                              {4, float_, no, no, no, "SCALAR", none, "features"},
                                              {12, float_, no, no, no, "VEC3", exponential, "places"},
                                              {16, float_, no, no, no, "VEC4", exponential, "places"},
                                              {4, unsigned_short, yes, no, no, "SCALAR", none, "features"}};
  return table[static_cast<std::size_t>(v)];
}

void Store::set_bounds(std::uint32_t a, const Bounds& bounds) {
  if (a == none || accessors_[a].bounds != none) return;
  accessors_[a].bounds = static_cast<std::uint32_t>(bounds_.size());
  bounds_.push_back(bounds);
}

std::uint32_t Store::positions(std::span<const float> values, const Bounds& bounds) {
  std::uint32_t a = add(View::position, values.data(), values.size_bytes());
  set_bounds(a, bounds);
  return a;
}

std::uint32_t Store::times(std::span<const float> values) {
  std::uint32_t a = add(View::time, values.data(), values.size_bytes());
  set_bounds(a, {{values.front(), 0, 0}, {values.back(), 0, 0}});
  return a;
}

std::uint32_t Store::raw(View view, std::string_view bytes, const Bounds* bounds) {
  std::uint32_t a = add(view, bytes.data(), bytes.size());
  if (bounds) set_bounds(a, *bounds);
  return a;
}

std::uint32_t Store::described(View view, std::uint32_t count, const Bounds* bounds) {
  accessors_.push_back({none, count, none, view});
  auto id = static_cast<std::uint32_t>(accessors_.size() - 1);
  if (bounds) set_bounds(id, *bounds);
  return id;
}

std::string Store::bytes(std::uint32_t id) const {
  const Accessor& a = accessors_[id];
  std::string out(std::size_t{a.count} * info(a.view).element, '\0');
  views_[static_cast<std::size_t>(a.view)].copy(a.offset, out.data(), out.size());
  return out;
}

std::uint32_t Store::vertices(View v, std::span<const float> values) {
  return add(v, values.data(), values.size_bytes());
}

std::uint32_t Store::indices(std::span<const std::uint32_t> values, std::size_t n_vertices) {
  if (n_vertices > max_vertices_16) return add(View::index32, values.data(), values.size_bytes());
  narrow_.assign(values.begin(), values.end());
  return add(View::index16, narrow_.data(), narrow_.size() * sizeof(std::uint16_t));
}

std::uint64_t Store::bytes() const {
  std::uint64_t sum = 0;
  for (const auto& v : views_) sum += v.size();
  return sum;
}

std::uint32_t Store::add(View view, const void* data, std::size_t n_bytes) {
  auto whole = std::hash<std::string_view>{}({static_cast<const char*>(data), n_bytes});
  auto hash = static_cast<std::uint32_t>(whole ^ whole >> 32) + static_cast<std::uint32_t>(view);
  Slot& slot = find(view, data, n_bytes, hash);
  if (slot.accessor != none) return slot.accessor;
  if (bytes() + n_bytes > most_) {
    full_ = true;
    return none;
  }
  auto& blocks = views_[static_cast<std::size_t>(view)];
  Accessor a{static_cast<std::uint32_t>(blocks.size()), static_cast<std::uint32_t>(n_bytes / info(view).element), none,
             view};
  blocks.append(data, n_bytes);
  auto id = static_cast<std::uint32_t>(accessors_.size());
  slot = {hash, id};
  accessors_.push_back(a);
  if (accessors_.size() * 2 > slots_.size()) grow();
  return id;
}

/// The slot that has the data, or the empty one where it belongs.
Store::Slot& Store::find(View view, const void* data, std::size_t n_bytes, std::uint32_t hash) {
  for (std::size_t i = hash & (slots_.size() - 1);; i = (i + 1) & (slots_.size() - 1)) {
    Slot& s = slots_[i];
    if (s.accessor == none) return s;
    const Accessor& a = accessors_[s.accessor];
    if (s.hash != hash || a.view != view || std::size_t{a.count} * info(view).element != n_bytes) continue;
    if (views_[static_cast<std::size_t>(view)].equal(a.offset, data, n_bytes)) return s;
  }
}

void Store::grow() {
  std::vector<Slot> old(slots_.size() * 2);
  old.swap(slots_);
  for (const Slot& s : old) {
    if (s.accessor == none) continue;
    std::size_t i = s.hash & (slots_.size() - 1);
    while (slots_[i].accessor != none) i = (i + 1) & (slots_.size() - 1);
    slots_[i] = s;
  }
}

}  // namespace wrlkit::gltf

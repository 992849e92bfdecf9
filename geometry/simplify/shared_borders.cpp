#include "geometry/simplify/shared_borders.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenegraph/places/places.h"

namespace wrlkit {
namespace {

constexpr std::size_t most_entries = 20'000'000;  // of positions in places; the borders of what comes later are free
constexpr std::size_t most_moved = 500'000'000;   // positions through matrices, with the same effect
constexpr double tolerance = 0x1p-20;             // of the largest coordinate
constexpr double near_origin = 0x1p-8;  // of the largest coordinate of the world, which counts as such at least

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 31) * 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 29) * 0xbf58476d1ce4e5b9u;
  return x ^ x >> 32;
}

/// A position in a place, by a cell that it lies in or is very near to.
struct Entry {
  std::uint64_t cell;
  std::uint32_t part, border;
};

/// Cells are some times as wide as what counts as the same, so that equal positions have a cell in common although each
/// is usually entered in one or two.
class Cells {
 public:
  explicit Cells(double least) : least_(least) {}

  void add(const Vec3& p, std::uint32_t part, std::uint32_t border, std::vector<Entry>& entries) const {
    const double size = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2]), least_});
    if (!(size > 0) || !std::isfinite(size)) return;
    const int low = std::ilogb(size * (1 - tolerance)), high = std::ilogb(size * (1 + tolerance));
    for (int level = low; level <= high; ++level) add_level(p, level, {0, part, border}, entries);
  }

 private:
  static void add_level(const Vec3& p, int level, Entry e, std::vector<Entry>& entries) {
    const double reach = std::ldexp(tolerance, level), width = 8 * reach;
    std::array<std::array<std::int64_t, 2>, 3> range;
    for (std::size_t k = 0; k < 3; ++k)
      range[k] = {std::llround((p[k] - reach) / width), std::llround((p[k] + reach) / width)};
    for (auto x = range[0][0]; x <= range[0][1]; ++x)
      for (auto y = range[1][0]; y <= range[1][1]; ++y)
        for (auto z = range[2][0]; z <= range[2][1]; ++z) {
          e.cell = static_cast<std::uint64_t>(level);
          for (auto i : {x, y, z}) e.cell = mixed(e.cell + static_cast<std::uint64_t>(i));
          entries.push_back(e);
        }
  }

  double least_;
};

}  // namespace

/// Around a vertex whose faces close, every neighbour is next to two of them. So the sum of numbers that stand for the
/// neighbours, without carry, is zero there, and nearly never on a border.
void SharedBorders::add(const Mesh& mesh) {
  local_.reset(mesh.n_positions());
  used_.clear();
  open_.clear();
  auto sum = [&](std::uint32_t p) -> std::uint64_t& {
    if (!local_.contains(p)) {
      local_.set(p, static_cast<std::uint32_t>(used_.size()));
      used_.push_back(p);
      open_.push_back(0);
    }
    return open_[local_[p]];
  };
  for (std::size_t c = 0; mesh.is_triangles() && c + 2 < mesh.corners.size(); c += 3) {
    const std::uint32_t* v = &mesh.corners[c];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    for (int k = 0; k < 3; ++k) sum(v[k]) ^= mixed(v[(k + 1) % 3] + 1) ^ mixed(v[(k + 2) % 3] + 1);
  }
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (open_[i] == 0) continue;
    const std::size_t p = std::size_t{3} * used_[i];
    position_.push_back(used_[i]);
    point_.push_back({mesh.positions[p], mesh.positions[p + 1], mesh.positions[p + 2]});
  }
  end_.push_back(position_.size());
}

std::vector<std::vector<std::uint32_t>> SharedBorders::find(const Scene& scene,
                                                            std::span<const ShapeSurface> surfaces) const {
  std::vector<std::vector<std::uint32_t>> out(end_.size());
  const auto number = surface_numbers(scene, surfaces);
  auto for_each_border = [&](auto f) {
    std::uint32_t part = 0;
    std::size_t n_left = most_moved;
    std::vector<Matrix> last(end_.size());
    std::vector<char> is_placed(end_.size());
    for_each_place(scene, Shown::all, [&](NodeId shape, const Matrix& m) {
      const auto i = number[shape.value];
      if (i == 0) return;
      // Several children of a Switch may be the same surface in the same place: it does not border on itself.
      if (is_placed[i - 1] && last[i - 1].m == m.m) return;
      last[i - 1] = m;
      is_placed[i - 1] = 1;
      ++part;
      const std::size_t begin = i > 1 ? end_[i - 2] : 0;
      if (end_[i - 1] - begin > n_left) return;
      n_left -= end_[i - 1] - begin;
      for (std::size_t b = begin; b < end_[i - 1]; ++b) f(m.point(point_[b]), part, static_cast<std::uint32_t>(b));
    });
  };
  double largest = 0;
  for_each_border([&](const Vec3& p, auto, auto) {
    for (double x : p)
      if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
  });
  const Cells cells(largest * near_origin);
  std::vector<Entry> entries;
  for_each_border([&](const Vec3& p, std::uint32_t part, std::uint32_t border) {
    if (entries.size() < most_entries) cells.add(p, part, border, entries);
  });
  std::ranges::sort(entries, {}, [](const Entry& e) { return std::pair(e.cell, e.part); });
  std::vector<char> shared(position_.size());
  for (std::size_t i = 0, end; i < entries.size(); i = end) {
    for (end = i; end < entries.size() && entries[end].cell == entries[i].cell;) ++end;
    if (entries[i].part == entries[end - 1].part) continue;
    for (std::size_t k = i; k < end; ++k) shared[entries[k].border] = 1;
  }
  for (std::size_t s = 0, b = 0; s < end_.size(); ++s) {
    for (; b < end_[s]; ++b)
      if (shared[b]) out[s].push_back(position_[b]);
    std::ranges::sort(out[s]);
  }
  return out;
}

}  // namespace wrlkit

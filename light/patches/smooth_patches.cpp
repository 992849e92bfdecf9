#include "light/patches/smooth_patches.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "base/hashing.h"

namespace wrlkit::light {
namespace {

constexpr double smooth_cosine = 0.97;

double twice_area(const MeetingPatch& p) {
  return length(cross(p.corners[1] - p.corners[0], p.corners[2] - p.corners[0]));
}

double angle_at(const MeetingPatch& p, std::size_t i) {
  const V3 a = p.corners[(i + 1) % 3] - p.corners[i], b = p.corners[(i + 2) % 3] - p.corners[i];
  return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Corners of patches that are one vertex, although each was printed by itself. One joins the first that is near
/// enough, so vertices cannot drift.
class VertexTable {
 public:
  VertexTable(double tolerance, const V3& origin) : tolerance_(tolerance), cell_(4 * tolerance), origin_(origin) {}

  std::uint32_t number(const V3& place, const V3& normal) {
    const V3 p = place - origin_;
    for (auto x = cell_of(p.x - tolerance_); x <= cell_of(p.x + tolerance_); ++x)
      for (auto y = cell_of(p.y - tolerance_); y <= cell_of(p.y + tolerance_); ++y)
        for (auto z = cell_of(p.z - tolerance_); z <= cell_of(p.z + tolerance_); ++z) {
          const auto [from, to] = cells_.equal_range(key(x, y, z));
          for (auto i = from; i != to; ++i)
            if (const Vertex& v = vertices_[i->second];
                length(v.place - p) <= tolerance_ && dot(v.normal, normal) >= smooth_cosine)
              return i->second;
        }
    const auto n = static_cast<std::uint32_t>(vertices_.size());
    cells_.emplace(key(cell_of(p.x), cell_of(p.y), cell_of(p.z)), n);
    vertices_.push_back({p, normal});
    return n;
  }
  std::size_t size() const { return vertices_.size(); }

 private:
  struct Vertex {
    V3 place, normal;
  };

  std::int64_t cell_of(double v) const {
    return static_cast<std::int64_t>(std::clamp(std::floor(v / cell_), -0x1p62, 0x1p62));
  }
  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
    std::uint64_t h = 0;
    for (auto v : {x, y, z}) h = mixed(h, static_cast<std::uint64_t>(v));
    return h;
  }

  double tolerance_, cell_;
  V3 origin_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
  std::vector<Vertex> vertices_;
};

}  // namespace

std::vector<std::array<V3, 3>> smooth_colors(std::span<const MeetingPatch> patches) {
  std::vector<std::array<V3, 3>> out;
  out.reserve(patches.size());
  for (const auto& p : patches) out.push_back({p.color, p.color, p.color});
  double area = 0;
  for (const auto& p : patches) area += 0.5 * twice_area(p);
  if (!(area > 0) || !std::isfinite(area)) return out;
  VertexTable table(1e-3 * std::sqrt(2 * area / static_cast<double>(patches.size())), patches[0].corners[0]);
  std::vector<std::array<std::uint32_t, 3>> numbers(patches.size());
  std::vector<V3> sum;
  std::vector<double> weight;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto n = numbers[p][i] = table.number(patches[p].corners[i], patches[p].normals[i]);
      sum.resize(table.size());
      weight.resize(table.size());
      const double angle = angle_at(patches[p], i);
      sum[n] += angle * patches[p].color;
      weight[n] += angle;
    }
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t i = 0; i < 3; ++i)
      if (weight[numbers[p][i]] > 0) out[p][i] = (1 / weight[numbers[p][i]]) * sum[numbers[p][i]];
  return out;
}

}  // namespace wrlkit::light

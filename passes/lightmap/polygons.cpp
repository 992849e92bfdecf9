#include "passes/lightmap/polygons.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "base/math/vec.h"

namespace wrlkit::bake {
namespace {

constexpr double straight = 1e-6;  // rounding of a corner between two sides of one line, by the area

/// What a corner shows: two corners of one face are the same when all of it is.
using CornerKey = std::array<std::uint32_t, 5>;

/// A side of a triangle that no other triangle of the face goes along the other way.
struct Side {
  std::uint32_t from, to;  // numbers of keys
  std::uint32_t corner;    // it begins there
  auto operator<=>(const Side&) const = default;
};

class Joining {
 public:
  explicit Joining(Mesh& mesh) : mesh_(mesh) {}

  void run() {
    const std::size_t n = mesh_.corners.size() / 3;
    std::vector<std::uint32_t> begin{0};
    while (triangle_ < n)
      for (std::size_t f = 0; f < mesh_.cut.size() && triangle_ < n; ++f) {
        const std::size_t end = std::min<std::size_t>(n, triangle_ + mesh_.cut[f]);
        if (!join(end))
          for (; triangle_ < end; ++triangle_) {
            add(3 * triangle_, 3);
            begin.push_back(static_cast<std::uint32_t>(order_.size()));
          }
        else
          begin.push_back(static_cast<std::uint32_t>(order_.size()));
        triangle_ = end;
      }
    if (begin.size() == n + 1) return;
    gather(mesh_.corners);
    for (Attribute* a : mesh_.attributes())
      if (a->present()) gather(a->index);
    mesh_.face_begin = std::move(begin);
    mesh_.cut.clear();
  }

 private:
  void add(std::size_t corner, int count) {
    for (int k = 0; k < count; ++k)
      order_.push_back(static_cast<std::uint32_t>(corner) + static_cast<std::uint32_t>(k));
  }

  CornerKey key(std::uint32_t corner) const {
    CornerKey out{mesh_.corners[corner]};
    std::size_t i = 0;
    for (const Attribute* a : std::as_const(mesh_).attributes()) out[++i] = a->present() ? a->index[corner] : 0;
    return out;
  }

  /// The outline of the triangles up to `end`, as corners, if it is one ring that goes through each of its corners
  /// once.
  bool join(std::size_t end) {
    if (end < triangle_ + 2) return false;
    list_outline(end);
    if (sides_.size() != end - triangle_ + 2) return false;
    const std::size_t start = order_.size();
    const Side* s = &sides_[0];
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      order_.push_back(s->corner);
      const auto next = std::ranges::lower_bound(sides_, s->to, {}, &Side::from);
      const bool closes =
          next != sides_.end() && next->from == s->to && (next == sides_.begin()) == (i + 1 == sides_.size());
      if (!closes) {
        order_.resize(start);
        return false;
      }
      s = &*next;
    }
    if (mesh_.convex && !is_convex(start)) {
      order_.resize(start);
      return false;
    }
    // It begins where the face of the file did, as far as that is known: at the first corner of its first triangle.
    const auto first =
        std::ranges::find_if(order_.begin() + static_cast<std::ptrdiff_t>(start), order_.end(),
                             [&](std::uint32_t c) { return key(c) == key(static_cast<std::uint32_t>(3 * triangle_)); });
    if (first != order_.end()) std::rotate(order_.begin() + static_cast<std::ptrdiff_t>(start), first, order_.end());
    return true;
  }

  void list_outline(std::size_t end) {
    keys_.clear();
    all_.clear();
    sides_.clear();
    for (auto c = static_cast<std::uint32_t>(3 * triangle_); c < 3 * end; ++c) keys_.push_back(key(c));
    std::ranges::sort(keys_);
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    auto number = [&](std::uint32_t c) {
      return static_cast<std::uint32_t>(std::ranges::lower_bound(keys_, key(c)) - keys_.begin());
    };
    for (auto c = static_cast<std::uint32_t>(3 * triangle_); c < 3 * end; ++c)
      all_.push_back({number(c), number(c - c % 3 + (c + 1) % 3), c});
    std::ranges::sort(all_);
    for (const Side& s : all_) {
      const auto other = std::ranges::lower_bound(all_, Side{s.to, s.from, 0});
      if (other == all_.end() || other->from != s.to || other->to != s.from) sides_.push_back(s);
    }
  }

  Vec3 at(std::uint32_t corner) const { return vec3(mesh_.positions.data() + std::size_t{3} * mesh_.corners[corner]); }

  /// Seen along the sum of its triangles' normals it turns the same way everywhere.
  bool is_convex(std::size_t start) const {
    Vec3 sum{};
    const std::size_t n = order_.size() - start;
    auto corner = [&](std::size_t i) { return at(order_[start + i % n]); };
    for (std::size_t i = 1; i + 1 < n; ++i) sum = sum + cross(corner(i) - corner(0), corner(i + 1) - corner(0));
    for (std::size_t i = 0; i < n; ++i)
      if (!(dot(cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i + 1)), sum) >= -straight * dot(sum, sum)))
        return false;
    return true;
  }

  void gather(std::vector<std::uint32_t>& index) const {
    std::vector<std::uint32_t> to;
    to.reserve(order_.size());
    for (std::uint32_t c : order_) to.push_back(index[c]);
    index = std::move(to);
  }

  Mesh& mesh_;
  std::size_t triangle_ = 0;
  std::vector<std::uint32_t> order_;  // corners of the new faces
  std::vector<CornerKey> keys_;       // of the face at work
  std::vector<Side> all_, sides_;
};

}  // namespace

void join_cut_faces(Mesh& mesh) {
  const std::size_t once = std::accumulate(mesh.cut.begin(), mesh.cut.end(), std::size_t{0});
  if (mesh.is_triangles() && once && mesh.corners.size() % (3 * once) == 0) Joining(mesh).run();
}

}  // namespace wrlkit::bake

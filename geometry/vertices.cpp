// One look-up per corner: the vertices of a position hang in a list, in which the one sought is nearly always the first
// or second. A list is not searched beyond its first vertices, though: the apex of a cone with flat sides may have a
// hundred thousand. What would come later in a list is in a hash table, which most meshes never touch.
#include "geometry/vertices.h"

#include <bit>
#include <cmath>
#include <limits>

namespace wrlkit {
namespace {

constexpr std::uint32_t none = 0xffffffffu;
constexpr int longest_list = 8;
constexpr std::size_t smallest_table = 16;  // a power of two, as every size of the table
constexpr std::size_t n_shades = 1024;      // a power of two

using Vertex = SplitScratch::Vertex;

bool same(const Vertex& a, const Vertex& b) {
  return a.position == b.position && a.normal == b.normal && a.color == b.color && a.texcoord == b.texcoord &&
         a.lightcoord == b.lightcoord;
}

std::uint64_t hash(const Vertex& v) {
  std::uint64_t h = v.position * 0x9e3779b97f4a7c15u;
  for (std::uint32_t i : {v.normal, v.color, v.texcoord, v.lightcoord}) h = (h ^ h >> 29 ^ i) * 0xbf58476d1ce4e5b9u;
  return h ^ h >> 32;
}

// -- which corners are one vertex

class Splitter {
 public:
  Splitter(const Mesh& mesh, const SplitOptions& options, SplitScratch& scratch) : mesh_(mesh), scratch_(scratch) {
    if (options.normals && mesh.normal.present()) normal_ = mesh.normal.index.data();
    if (options.colors && mesh.color.present()) color_ = mesh.color.index.data();
    if (options.texcoords && mesh.texcoord.present()) texcoord_ = mesh.texcoord.index.data();
    if (options.lightcoords && mesh.lightcoord.present()) lightcoord_ = mesh.lightcoord.index.data();
  }

  void split() {
    scratch_.vertices.clear();
    scratch_.in_table.clear();
    scratch_.table.assign(smallest_table, none);
    scratch_.first.reset(mesh_.n_positions());
    scratch_.of_corner.resize(mesh_.corners.size());
    for (std::uint32_t c = 0; c < mesh_.corners.size(); ++c) scratch_.of_corner[c] = vertex(c);
  }

 private:
  std::uint32_t vertex(std::uint32_t corner);
  std::uint32_t add(const Vertex&);
  std::uint32_t look_up(const Vertex&);
  void rebuild_table(std::size_t size);

  const Mesh& mesh_;
  SplitScratch& scratch_;
  const std::uint32_t *normal_ = nullptr, *color_ = nullptr, *texcoord_ = nullptr, *lightcoord_ = nullptr;
};

std::uint32_t Splitter::vertex(std::uint32_t c) {
  auto index = [c](const std::uint32_t* stream) { return stream ? stream[c] : 0; };
  Vertex v{mesh_.corners[c], index(normal_), index(color_), index(texcoord_), index(lightcoord_), none};
  if (!scratch_.first.contains(v.position)) {
    scratch_.first.set(v.position, add(v));
    return scratch_.first[v.position];
  }
  std::uint32_t at = scratch_.first[v.position];
  for (int i = 1;; ++i) {
    if (same(scratch_.vertices[at], v)) return at;
    if (i == longest_list) return look_up(v);
    std::uint32_t next = scratch_.vertices[at].next;
    if (next == none) break;
    at = next;
  }
  return scratch_.vertices[at].next = add(v);
}

std::uint32_t Splitter::add(const Vertex& v) {
  scratch_.vertices.push_back(v);
  return static_cast<std::uint32_t>(scratch_.vertices.size() - 1);
}

std::uint32_t Splitter::look_up(const Vertex& v) {
  std::vector<std::uint32_t>& table = scratch_.table;
  if (2 * scratch_.in_table.size() >= table.size()) rebuild_table(2 * table.size());
  for (std::size_t i = hash(v);; ++i) {
    std::uint32_t& slot = table[i & (table.size() - 1)];
    if (slot == none) {
      scratch_.in_table.push_back(slot = add(v));
      return slot;
    }
    if (same(scratch_.vertices[slot], v)) return slot;
  }
}

void Splitter::rebuild_table(std::size_t size) {
  scratch_.table.assign(size, none);
  for (std::uint32_t v : scratch_.in_table) {
    std::size_t i = hash(scratch_.vertices[v]);
    while (scratch_.table[i & (size - 1)] != none) ++i;
    scratch_.table[i & (size - 1)] = v;
  }
}

// -- values

/// Replaces what glTF does not allow: 0 for what is not a number, the largest for what is too large.
float finite(double x, std::size_t& n_not_finite) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (std::abs(x) <= largest) return static_cast<float>(x);
  ++n_not_finite;
  return static_cast<float>(x > 0 ? largest : x < 0 ? -largest : 0);
}

void fill_positions(const Mesh& mesh, const std::vector<Vertex>& vertices, Vertices& out) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const double* from = mesh.positions.data();
  std::array<float, 3> min{infinity, infinity, infinity}, max{-infinity, -infinity, -infinity};
  out.position.resize(3 * vertices.size());
  float* to = out.position.data();
  for (const Vertex& v : vertices) {
    for (int i = 0; i < 3; ++i) {
      float x = finite(from[std::size_t{3} * v.position + i] - out.origin[i], out.n_not_finite);
      min[i] = std::min(min[i], x);
      max[i] = std::max(max[i], x);
      *to++ = x;
    }
  }
  if (!vertices.empty()) {
    out.min = min;
    out.max = max;
  }
}

/// Unit length; left alone where it is already, so that exact normals stay exact. All zero without a direction.
void unit(const float* from, float* to) {
  double x = from[0], y = from[1], z = from[2], square = x * x + y * y + z * z;
  double scale = std::abs(square - 1) < 1e-6 ? 1 : 1 / std::sqrt(square);
  bool usable = square > 0 && square <= std::numeric_limits<double>::max();
  to[0] = usable ? static_cast<float>(x * scale) : 0;
  to[1] = usable ? static_cast<float>(y * scale) : 0;
  to[2] = usable ? static_cast<float>(z * scale) : 0;
}

/// Newell's normal of a face, turned to its front.
std::array<float, 3> face_normal(const Mesh& mesh, std::size_t begin, std::size_t end) {
  double n[3] = {};
  auto edge = [&](std::size_t c, int axis) {
    const double* p = mesh.positions.data();
    return p[std::size_t{3} * mesh.corners[c] + axis] - p[std::size_t{3} * mesh.corners[begin] + axis];
  };
  for (std::size_t c = begin + 1; c + 1 < end; ++c)
    for (int i = 0; i < 3; ++i) {
      int j = (i + 1) % 3, k = (i + 2) % 3;
      n[i] += edge(c, j) * edge(c + 1, k) - edge(c, k) * edge(c + 1, j);
    }
  double length = std::hypot(n[0], n[1], n[2]) * (mesh.ccw ? 1 : -1);
  std::array<float, 3> out{};
  if (length != 0 && std::isfinite(length))
    for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(n[i] / length);
  return out;
}

bool is_zero(const float* n) { return n[0] == 0 && n[1] == 0 && n[2] == 0; }

/// A vertex without a normal takes that of the first of its faces that has one.
void repair_normals(const Mesh& mesh, const std::vector<std::uint32_t>& of_corner, Vertices& out) {
  for (std::size_t f = 0; mesh.kind == Mesh::Kind::faces && f < mesh.n_faces(); ++f) {
    std::size_t begin = mesh.begin_of(f), end = mesh.end_of(f);
    std::array<float, 3> n{};
    for (std::size_t c = begin; c < end; ++c) {
      float* normal = out.normal.data() + std::size_t{3} * of_corner[c];
      if (!is_zero(normal)) continue;
      if (is_zero(n.data())) n = face_normal(mesh, begin, end);
      if (is_zero(n.data())) break;
      std::copy(n.begin(), n.end(), normal);
    }
  }
  for (std::size_t i = 0; i < out.normal.size(); i += 3)
    if (is_zero(&out.normal[i])) out.normal[i + 2] = 1;
}

void fill_normals(const Mesh& mesh, const SplitScratch& scratch, Vertices& out) {
  out.normal.resize(3 * scratch.vertices.size());
  float* to = out.normal.data();
  bool all = true;
  for (const Vertex& v : scratch.vertices) {
    unit(mesh.normal.at(v.normal), to);
    all &= !is_zero(to);
    to += 3;
  }
  if (!all) repair_normals(mesh, scratch.of_corner, out);
}

/// IEC 61966-2-1.
float linear(float x) { return static_cast<float>(x <= 0.04045f ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4)); }

/// The exact function costs 30 ns, but the numbers of colors repeat. An entry is right whenever it was made, so that
/// the table need not be cleared: 0 becomes 0, as at the beginning.
float shade(SplitScratch& scratch, float x) {
  if (scratch.shades.empty()) scratch.shades.resize(n_shades, {0, 0});
  std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  SplitScratch::Shade& s = scratch.shades[(bits * 0x9e3779b9u) >> 22];
  if (s.from != bits) s = {bits, linear(x)};
  return s.to;
}

void fill_colors(const Mesh& mesh, const SplitOptions& options, SplitScratch& scratch, Vertices& out) {
  int width = out.color_width = mesh.color.width;
  out.color.resize(width * scratch.vertices.size());
  float* to = out.color.data();
  for (const Vertex& v : scratch.vertices) {
    const float* from = mesh.color.at(v.color);
    for (int i = 0; i < width; ++i) {
      float x = from[i] > 0 ? std::min(from[i], 1.f) : 0;  // not a number: 0
      *to++ = options.linear_colors && i < 3 ? shade(scratch, x) : x;
    }
  }
}

/// Places in a picture: texcoord or lightcoord.
void fill_places(const Attribute& values, const SplitOptions& options, const std::vector<Vertex>& vertices,
                 std::uint32_t Vertex::*index, std::vector<float>& out, std::size_t& n_not_finite) {
  out.resize(2 * vertices.size());
  float* to = out.data();
  for (const Vertex& v : vertices) {
    const float* from = values.at(v.*index);
    *to++ = finite(from[0], n_not_finite);
    *to++ = finite(options.flip_v ? 1 - double{from[1]} : from[1], n_not_finite);
  }
}

// -- indices

class Indices {
 public:
  Indices(const Mesh& mesh, bool reversed, const std::uint32_t* of_corner, Vertices& out)
      : mesh_(mesh), reversed_(reversed), of_corner_(of_corner), out_(out) {}

  void fill() {
    switch (mesh_.kind) {
      case Mesh::Kind::none:
        break;
      case Mesh::Kind::faces:
        triangles();
        break;
      case Mesh::Kind::lines:
        segments();
        break;
      case Mesh::Kind::points:
        out_.index.assign(of_corner_, of_corner_ + mesh_.corners.size());
        break;
    }
  }

 private:
  void triangles() {
    std::size_t n = 0;  // of all faces of n corners, n - 2
    for (std::size_t f = 0; f < mesh_.n_faces(); ++f)
      n += std::max<std::size_t>(mesh_.end_of(f) - mesh_.begin_of(f), 2) - 2;
    out_.index.resize(3 * n);
    std::uint32_t* to = out_.index.data();
    for (std::size_t f = 0; f < mesh_.n_faces(); ++f) {
      std::size_t first = mesh_.begin_of(f), last = mesh_.end_of(f);
      for (std::size_t c = first + 1; c + 1 < last; ++c)
        to = triangle(of_corner_[first], of_corner_[c], of_corner_[c + 1], to);
    }
    out_.index.resize(to - out_.index.data());
    out_.n_dropped = n - out_.index.size() / 3;
  }

  std::uint32_t* triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t* to) const {
    to[0] = a;
    to[1] = reversed_ ? c : b;
    to[2] = reversed_ ? b : c;
    return a == b || b == c || c == a ? to : to + 3;
  }

  void segments() {
    for (std::size_t f = 0; f < mesh_.n_faces(); ++f)
      for (std::size_t c = mesh_.begin_of(f); c + 1 < mesh_.end_of(f); ++c)
        out_.index.insert(out_.index.end(), {of_corner_[c], of_corner_[c + 1]});
  }

  const Mesh& mesh_;
  bool reversed_;
  const std::uint32_t* of_corner_;
  Vertices& out_;
};

}  // namespace

void Vertices::clear() {
  position.clear();
  normal.clear();
  color.clear();
  texcoord.clear();
  lightcoord.clear();
  feature.clear();
  index.clear();
  color_width = 3;
  origin = {};
  min = max = {};
  n_dropped = n_not_finite = 0;
}

void split_vertices(const Mesh& mesh, const SplitOptions& options, SplitScratch& scratch, Vertices& out) {
  out.clear();
  out.origin = options.origin;
  if (mesh.kind == Mesh::Kind::none) return;
  Splitter(mesh, options, scratch).split();
  fill_positions(mesh, scratch.vertices, out);
  if (options.normals && mesh.normal.present()) fill_normals(mesh, scratch, out);
  if (options.colors && mesh.color.present()) fill_colors(mesh, options, scratch, out);
  auto places = [&](const Attribute& a, std::uint32_t Vertex::*index, std::vector<float>& to) {
    fill_places(a, options, scratch.vertices, index, to, out.n_not_finite);
  };
  if (options.texcoords && mesh.texcoord.present()) places(mesh.texcoord, &Vertex::texcoord, out.texcoord);
  if (options.lightcoords && mesh.lightcoord.present()) places(mesh.lightcoord, &Vertex::lightcoord, out.lightcoord);
  Indices(mesh, mesh.ccw == options.mirror, scratch.of_corner.data(), out).fill();
}

}  // namespace wrlkit

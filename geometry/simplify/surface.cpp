#include "geometry/simplify/surface.h"

#include <algorithm>

namespace wrlkit::simplify {
namespace {

/// Numbers the positions that the corners use in the order of their first use. When the positions are very many more
/// than the corners (a face of a Shape that re-uses a long list), the order is theirs, and they are not all touched.
std::vector<std::uint32_t> number(const Mesh& mesh, std::vector<std::uint32_t>& vertex_of_corner) {
  std::vector<std::uint32_t> used;
  vertex_of_corner.resize(mesh.corners.size());
  if (mesh.n_positions() / 8 <= mesh.corners.size()) {
    std::vector<std::uint32_t> id(mesh.n_positions(), none);
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
      std::uint32_t p = mesh.corners[c];
      if (id[p] == none) {
        id[p] = static_cast<std::uint32_t>(used.size());
        used.push_back(p);
      }
      vertex_of_corner[c] = id[p];
    }
    return used;
  }
  used = mesh.corners;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    vertex_of_corner[c] =
        static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), mesh.corners[c]) - used.begin());
  return used;
}

}  // namespace

Surface::Surface(const Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  original_ = number(mesh, corners);
  original_.shrink_to_fit();
  vertex.resize(original_.size());
  for (std::size_t v = 0; v < original_.size(); ++v)
    for (int i = 0; i < 3; ++i) vertex[v].position[i] = mesh.positions[3 * std::size_t{original_[v]} + i];
  face.resize(corners.size() / 3);
  for (std::size_t f = 0; f < face.size(); ++f) {
    std::uint32_t a = corners[3 * f], b = corners[3 * f + 1], c = corners[3 * f + 2];
    bool triangle = a != b && b != c && c != a;
    face[f] = {{triangle ? a : none, b, c}, 0};
    n_live_ += triangle;
  }
  make_lists();
}

std::uint32_t Surface::vertex_of(std::uint32_t original) const {
  auto at = std::find(original_.begin(), original_.end(), original);
  return at == original_.end() ? none : static_cast<std::uint32_t>(at - original_.begin());
}

/// Afresh from the faces that are alive. There is room for half as many entries more, so that this is done a few times
/// only in the life of a surface.
void Surface::make_lists() {
  for (Vertex& v : vertex) v.size = v.capacity = v.degree = 0;
  for (const Triangle& t : face)
    if (t.v[0] != none)
      for (std::uint32_t v : t.v) ++vertex[v].capacity;
  pool_used_ = 0;
  for (Vertex& v : vertex) {
    v.begin = static_cast<std::uint32_t>(pool_used_);
    v.degree = v.capacity;
    pool_used_ += v.capacity;
  }
  if (pool_.empty()) pool_.resize(pool_used_ + pool_used_ / 2 + 2 * Ring::max_faces);
  for (std::uint32_t f = 0; f < face.size(); ++f)
    if (alive(f))
      for (std::uint32_t v : face[f].v) pool_[vertex[v].begin + vertex[v].size++] = f;
}

std::uint32_t Surface::across(std::uint32_t f, std::uint32_t a, std::uint32_t b) const {
  for (std::uint32_t g : std::span(pool_).subspan(vertex[a].begin, vertex[a].size)) {
    const auto& v = face[g].v;
    if (g != f && alive(g) && (v[0] == b || v[1] == b || v[2] == b)) return g;
  }
  return none;
}

bool Surface::gather(std::uint32_t v, Ring& ring) {
  Vertex& center = vertex[v];
  ring.center = v;
  ring.n_faces = ring.n_spokes = 0;
  if (center.degree == 0 || center.degree > Ring::max_faces) return false;
  // First all triangles, so that the cache fetches them side by side.
  Triangle triangles[Ring::max_faces];
  std::uint32_t* entries = pool_.data() + center.begin;
  int n = 0;
  for (std::uint32_t i = 0; i < center.size; ++i) {
    std::uint32_t f = entries[i];
    triangles[n] = face[f];
    if (triangles[n].v[0] != none) entries[n++] = f;
    if (n == Ring::max_faces) break;
  }
  for (int i = 0; i < n; ++i)
    for (std::uint32_t w : triangles[i].v) __builtin_prefetch(&vertex[w]);
  center.size = static_cast<std::uint32_t>(n);
  auto spoke = [&](std::uint32_t w) {
    int i = 0;
    while (i < ring.n_spokes && ring.spokes[i].vertex != w) ++i;
    if (i == ring.n_spokes) ring.spokes[ring.n_spokes++] = {w, 0, false, false};
    ++ring.spokes[i].n_faces;
    return static_cast<std::uint8_t>(i);
  };
  for (int i = 0; i < n; ++i) {
    const Triangle& t = triangles[i];
    std::uint8_t k = t.v[0] == v ? 0 : t.v[1] == v ? 1 : 2;
    std::uint8_t next = spoke(t.v[(k + 1) % 3]), prev = spoke(t.v[(k + 2) % 3]);
    ring.faces[ring.n_faces++] = {entries[i], k, next, prev};
    if (t.features == 0) continue;
    int at = k, before = (k + 2) % 3;
    ring.spokes[next].feature |= t.features >> at & 1;
    ring.spokes[next].crease |= t.features >> (at + 3) & 1;
    ring.spokes[prev].feature |= t.features >> before & 1;
    ring.spokes[prev].crease |= t.features >> (before + 3) & 1;
  }
  return true;
}

void Surface::classify(const Ring& ring) {
  int n = 0, n_creases = 0;
  bool is_open = false;
  for (const Ring::Spoke& s : ring.spoke_span()) {
    n += s.feature;
    n_creases += s.crease && !s.feature;
    is_open |= s.n_faces != 2;
  }
  auto by_lines = [](int lines) { return lines == 0 ? Kind::free : lines == 2 ? Kind::line : Kind::corner; };
  Vertex& v = vertex[ring.center];
  v.open = is_open;
  if (v.kind != Kind::fixed) v.kind = by_lines(n);
  v.crease_kind = std::max(v.kind, by_lines(n + n_creases));
}

void Surface::remove(std::uint32_t f) {
  for (std::uint32_t v : face[f].v) --vertex[v].degree;
  face[f].v[0] = none;
  --n_live_;
}

void Surface::merge(const Ring& from, const Ring& to) {
  std::uint32_t u = from.center, v = to.center;
  std::uint32_t joined[2 * Ring::max_faces], n = 0;
  // The edges of a removed face become one; a feature that either of them was is kept in the faces beyond.
  for (const Ring::Face& f : from.face_span()) {
    if (!from.has(f, v)) continue;
    std::uint32_t w = from.next_vertex(f) == v ? from.prev_vertex(f) : from.next_vertex(f);
    const Ring::Spoke &a = from.spokes[from.find(w)], &b = to.spokes[to.find(w)];
    const int bits = (a.feature || b.feature) | (a.crease || b.crease) << 3;
    if (bits == 0) continue;
    for (const Ring* ring : {&from, &to})
      for (const Ring::Face& g : ring->face_span()) {
        if (ring->next_vertex(g) == w) face[g.face].features |= bits << g.corner;
        if (ring->prev_vertex(g) == w) face[g.face].features |= bits << (g.corner + 2) % 3;
      }
  }
  for (const Ring::Face& f : to.face_span())
    if (to.has(f, u))
      remove(f.face);
    else
      joined[n++] = f.face;
  for (const Ring::Face& f : from.face_span())
    if (alive(f.face)) {
      face[f.face].v[f.corner] = v;
      joined[n++] = f.face;
    }
  if (vertex[u].capacity > vertex[v].capacity) {
    std::swap(vertex[u].begin, vertex[v].begin);
    std::swap(vertex[u].capacity, vertex[v].capacity);
  }
  vertex[u].size = vertex[u].degree = 0;
  store(v, joined, n);
}

void Surface::store(std::uint32_t v, const std::uint32_t* faces, std::uint32_t n) {
  Vertex& at = vertex[v];
  if (n > at.capacity) {
    if (pool_used_ + n > pool_.size()) return make_lists();
    at.begin = static_cast<std::uint32_t>(pool_used_);
    at.capacity = n;
    pool_used_ += n;
  }
  std::copy(faces, faces + n, pool_.begin() + at.begin);
  at.size = at.degree = n;
}

}  // namespace wrlkit::simplify

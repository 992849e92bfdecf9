// Corners are joined, not faces. Each edge knows its mate: the edge before it with the same two positions. Where the
// two faces are within creaseAngle, their corners at both ends of the edge are united. What hangs together then is a
// smoothing group: its corners are all at one position, and groups come in the order of their first corners.
//
// Mates are found without hashing or sorting: the edges are chained by their lower position, and while the chain of a
// position is walked, `seen` holds for each other end the edge that came last. A position with a hundred thousand edges
// costs what a hundred thousand positions with one edge do. All else are streams over the corners.
#include "geometry/normals.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "geometry/normals_scratch.h"
#include "scenegraph/value.h"

namespace wrlkit {
namespace {

using FaceNormal = NormalsScratch::FaceNormal;

using std::numbers::pi;

constexpr std::uint32_t no_edge = 0xffffffffu;
constexpr int compared_mates = 8;       // of one edge; what keeps an edge of very many faces linear
constexpr double flat_face = 1e-12;     // height by length of a face that counts as without area
constexpr float cancelled = 1e-30f;     // square of a sum that counts as zero
constexpr std::size_t n_recent = 4096;  // normals that are looked through for an equal one; a power of two

/// Room for n values that are written before they are read; shrinks never.
template <class T>
T* room(std::vector<T>& v, std::size_t n) {
  if (v.size() < n) {
    v.clear();
    v.resize(n);
  }
  return v.data();
}

/// Angle of the vector (x, y) to the x axis, in [0, 2 pi), to 2e-5; small angles to 2e-3 of themselves. That is plenty
/// for a weight, and branches for reflex corners only. The rational u is the tangent of the angle to the diagonal.
/// Vectors just below the axis have no angle rather than a full turn: they are spikes of a polygon.
double turn(double x, double y) {
  double ax = std::abs(x), ay = std::abs(y), u = (ay - ax) / (ay + ax), s = u * u;
  double h = (0.2144573526 - 0.1156678464 * s) + (0.06372045336 - 0.02024576881 * s) * (s * s);
  double to_diagonal = u * (pi / 4 + (1 - s) * h);
  double r = pi / 2 - std::copysign(pi / 4 - to_diagonal, x);
  return y < 0 && r > 1e-6 ? 2 * pi - r : r;
}

class Normals {
 public:
  Normals(Mesh& mesh, MeshScratch& scratch)
      : mesh_(mesh),
        scratch_(scratch_of(scratch)),
        map_(scratch.map),
        positions_(mesh.positions.data()),
        corners_(mesh.corners.data()),
        n_corners_(mesh.corners.size()),
        begin_(mesh.face_begin.empty() ? nullptr : mesh.face_begin.data()),
        n_faces_(static_cast<std::uint32_t>(mesh.n_faces())),
        recent_(room(scratch_.recent, n_recent)) {}

  void compute(double crease_angle) {
    bool no_gaps = face_normals();
    bool smooth = crease_angle > 0 && n_faces_ > 1;
    if (smooth || !no_gaps) {
      number_positions();
      chain_edges();
      find_mates();
    }
    if (!no_gaps) fill_gaps();
    if (!smooth) return emit_faces();
    unite_corners(crease_angle);
    make_groups();
    add_up();
    emit_groups();
  }

 private:
  static NormalsScratch& scratch_of(MeshScratch& s) {
    if (!s.normals) s.normals = std::make_shared<NormalsScratch>();
    return *s.normals;
  }

  std::uint32_t begin(std::uint32_t face) const { return begin_ ? begin_[face] : 3 * face; }
  std::uint32_t end(std::uint32_t face) const { return begin(face + 1); }
  std::uint32_t face_of(std::uint32_t corner) const { return begin_ ? face_of_[corner] : corner / 3; }
  std::uint32_t after(std::uint32_t corner, std::uint32_t face) const {
    return corner + 1 == end(face) ? begin(face) : corner + 1;
  }
  Vec3 point(std::uint32_t corner) const { return vec3(positions_ + std::size_t{3} * corners_[corner]); }

  bool face_normals();
  FaceNormal face_normal(std::uint32_t begin, std::uint32_t end) const;
  void number_positions();
  void chain_edges();
  void find_mates();
  void fill_gaps();
  void unite_corners(double crease_angle);
  void unite_across(std::uint32_t corner, std::uint32_t next, std::uint32_t face, float chord);
  void make_groups();
  void add_up();
  double angle(const Vec3& in, const Vec3& out, const Vec3& up) const;
  void emit_faces();
  void emit_groups();
  std::uint32_t value(float x, float y, float z);
  std::uint32_t unit_value(const float* sum, const FaceNormal& otherwise);
  std::uint32_t* group_of() { return mesh_.normal.index.data(); }

  Mesh& mesh_;
  NormalsScratch& scratch_;
  StampedMap& map_;
  const double* positions_;
  const std::uint32_t* corners_;
  std::size_t n_corners_;
  const std::uint32_t* begin_;  // null: triangles
  std::uint32_t n_faces_;
  std::uint32_t* recent_;

  FaceNormal* normal_ = nullptr;       // per face; weight 0: without area
  const std::uint32_t* id_ = nullptr;  // per corner: its position, numbered below n_ids_
  std::size_t n_ids_ = 0;
  std::uint32_t* face_of_ = nullptr;  // per corner; triangles do without
  // Per corner, the edge from it to the next: its higher position, and the next edge of the chain, later its mate.
  NormalsScratch::Edge* edges_ = nullptr;
  std::uint32_t n_groups_ = 0, n_values_ = 0;
};

// -- faces

/// False when there are faces without area.
bool Normals::face_normals() {
  normal_ = room(scratch_.face_normals, n_faces_);
  bool all = true;
  for (std::uint32_t f = 0; f < n_faces_; ++f) {
    normal_[f] = face_normal(begin(f), end(f));
    all &= normal_[f].weight > 0;
  }
  return all;
}

/// Newell's normal, as the sum of the triangles that the first corner makes with each edge: where coordinates are
/// large, the differences are taken before anything else.
FaceNormal Normals::face_normal(std::uint32_t begin, std::uint32_t end) const {
  if (end - begin < 3) return {0, 0, 0, 0};
  Vec3 a = point(begin + 1) - point(begin), area{};
  double size = dot(a, a);
  for (std::uint32_t c = begin + 2; c < end; ++c) {
    Vec3 b = point(c) - point(begin), t = cross(a, b);
    for (int i = 0; i < 3; ++i) area[i] += t[i];
    size += dot(b, b);
    a = b;
  }
  double square = dot(area, area);
  if (!(square > flat_face * flat_face * size * size)) return {0, 0, 0, 0};  // what is not finite has no area either
  double scale = (mesh_.ccw ? 1 : -1) / std::sqrt(square);
  return {static_cast<float>(area[0] * scale) + 0.f, static_cast<float>(area[1] * scale) + 0.f,
          static_cast<float>(area[2] * scale) + 0.f, 1};  // + 0: no negative zeros
}

// -- edges

/// Positions are numbered again when the mesh uses few of many; then nothing here costs more than its corners.
void Normals::number_positions() {
  id_ = corners_;
  n_ids_ = mesh_.n_positions();
  if (n_ids_ <= 2 * n_corners_) return;
  std::uint32_t* ids = room(scratch_.ids, n_corners_);
  map_.reset(n_ids_);
  std::uint32_t n = 0;
  for (std::size_t c = 0; c < n_corners_; ++c) {
    if (!map_.contains(corners_[c])) map_.set(corners_[c], n++);
    ids[c] = map_[corners_[c]];
  }
  id_ = ids;
  n_ids_ = n;
}

void Normals::chain_edges() {
  std::uint32_t* first = room(scratch_.first_edge, n_ids_);
  std::fill_n(first, n_ids_, no_edge);
  edges_ = room(scratch_.edges, n_corners_);
  if (begin_) face_of_ = room(scratch_.face_of, n_corners_);
  for (std::uint32_t f = 0; f < n_faces_; ++f) {
    for (std::uint32_t c = begin(f), last = end(f); c < last; ++c) {
      std::uint32_t a = id_[c], b = id_[c + 1 == last ? begin(f) : c + 1], low = std::min(a, b);
      edges_[c] = {std::max(a, b), first[low]};
      first[low] = c;
      if (begin_) face_of_[c] = f;
    }
  }
}

/// From here on the link of an edge is its mate, or none.
void Normals::find_mates() {
  const std::uint32_t* first = scratch_.first_edge.data();
  NormalsScratch::Seen* seen = room(scratch_.seen, n_ids_);
  std::fill_n(seen, n_ids_, NormalsScratch::Seen{no_edge, no_edge});
  for (std::uint32_t p = 0; p < n_ids_; ++p) {
    for (std::uint32_t e = first[p]; e != no_edge;) {
      NormalsScratch::Seen& s = seen[edges_[e].other];
      std::uint32_t next = edges_[e].link;
      edges_[e].link = s.from == p ? s.edge : no_edge;
      s = {p, e};
      e = next;
    }
  }
}

/// A face without area takes the normal of the first neighbour that has one, which may itself have been given it.
void Normals::fill_gaps() {
  auto has = [](const FaceNormal& n) { return n.x != 0 || n.y != 0 || n.z != 0; };
  auto give = [](FaceNormal& to, const FaceNormal& from) { to = {from.x, from.y, from.z, 0}; };
  for (std::uint32_t c = 0; c < n_corners_; ++c) {
    if (edges_[c].link == no_edge) continue;
    FaceNormal &a = normal_[face_of(c)], &b = normal_[face_of(edges_[c].link)];
    if (has(a) != has(b)) has(a) ? give(b, a) : give(a, b);
  }
  for (std::uint32_t f = 0; f < n_faces_; ++f)
    if (!has(normal_[f])) normal_[f] = {0, 0, 1, 0};
}

// -- groups

/// Root of a corner in the forest of united corners, where no parent comes after its child.
std::uint32_t root(std::uint32_t* parent, std::uint32_t c) {
  while (parent[c] != c) c = parent[c] = parent[parent[c]];
  return c;
}

/// 1 when they were not united before.
std::uint32_t unite(std::uint32_t* parent, std::uint32_t a, std::uint32_t b) {
  a = root(parent, a);
  b = root(parent, b);
  parent[std::max(a, b)] = std::min(a, b);
  return a != b;
}

/// The angle between unit normals is compared by its chord, which single precision knows well where the cosine is
/// blind: at small angles. At pi the chord has no more to say, so that every edge is smooth.
void Normals::unite_corners(double crease_angle) {
  double half = std::sin(crease_angle / 2);
  float chord = crease_angle < pi ? static_cast<float>(4 * half * half) : 5.f;
  std::uint32_t* parent = group_of();
  for (std::uint32_t c = 0; c < n_corners_; ++c) parent[c] = c;
  n_groups_ = static_cast<std::uint32_t>(n_corners_);
  for (std::uint32_t f = 0; f < n_faces_; ++f)
    for (std::uint32_t c = begin(f), last = end(f); c < last; ++c)
      if (edges_[c].link != no_edge) unite_across(c, c + 1 == last ? begin(f) : c + 1, f, chord);
}

void Normals::unite_across(std::uint32_t corner, std::uint32_t next, std::uint32_t face, float chord) {
  const FaceNormal& n = normal_[face];
  std::uint32_t mate = edges_[corner].link;
  for (int k = 0; k < compared_mates && mate != no_edge; ++k, mate = edges_[mate].link) {
    std::uint32_t other = face_of(mate);
    const FaceNormal& m = normal_[other];
    float x = n.x - m.x, y = n.y - m.y, z = n.z - m.z;
    if (!(x * x + y * y + z * z < chord)) continue;
    bool opposite = id_[mate] != id_[corner];  // as it should be: the neighbour runs along the edge the other way
    std::uint32_t mate_next = after(mate, other);
    n_groups_ -= unite(group_of(), corner, opposite ? mate_next : mate);
    n_groups_ -= unite(group_of(), next, opposite ? mate : mate_next);
  }
}

/// Numbers the groups in the order of their first corners, and gives each the normal of its first face. Where another
/// face of the group has a different one, a sum is needed, which begins with zero; flat parts of a mesh do without.
void Normals::make_groups() {
  std::uint32_t *group = group_of(), *mixed = room(scratch_.groups, n_groups_), n_groups = 0;
  mesh_.normal.values.resize(std::size_t{3} * n_groups_);
  float* values = mesh_.normal.values.data();
  for (std::uint32_t f = 0; f < n_faces_; ++f) {
    const FaceNormal& n = normal_[f];
    for (std::uint32_t c = begin(f), last = end(f); c < last; ++c) {
      bool first = group[c] == c;
      std::uint32_t g = first ? n_groups++ : group[group[c]];  // a parent came before and is numbered already
      group[c] = g;
      float* v = values + std::size_t{3} * g;
      if (first) {
        v[0] = n.x;
        v[1] = n.y;
        v[2] = n.z;
        mixed[g] = 0;
      } else if (!mixed[g] && (v[0] != n.x || v[1] != n.y || v[2] != n.z)) {
        v[0] = v[1] = v[2] = 0;
        mixed[g] = 1;
      }
    }
  }
}

void Normals::add_up() {
  const std::uint32_t *group = group_of(), *mixed = scratch_.groups.data();
  float* values = mesh_.normal.values.data();
  const double newell = mesh_.ccw ? 1 : -1;
  for (std::uint32_t f = 0; f < n_faces_; ++f) {
    const FaceNormal n = normal_[f];
    std::uint32_t first = begin(f), last = end(f);
    if (n.weight == 0) continue;
    const Vec3 up{newell * n.x, newell * n.y, newell * n.z};
    Vec3 in = point(first) - point(last - 1);
    for (std::uint32_t c = first; c < last; ++c) {
      Vec3 out = point(c + 1 == last ? first : c + 1) - point(c);
      if (mixed[group[c]]) {
        float *v = values + std::size_t{3} * group[c], w = static_cast<float>(angle(in, out, up));
        v[0] += w * n.x;
        v[1] += w * n.y;
        v[2] += w * n.z;
      }
      in = out;
    }
  }
}

/// Interior angle of a face between two of its edges; `up` is Newell's side of it. Where an edge has no length there is
/// none, and 1 is as good as any: the quadrilaterals around the pole of a sphere may be like that, and all count the
/// same.
double Normals::angle(const Vec3& in, const Vec3& out, const Vec3& up) const {
  double x = -dot(in, out), y = dot(cross(in, out), up);
  return x == 0 && y == 0 ? 1 : turn(x, y);
}

// -- values

void Normals::emit_faces() {
  mesh_.normal.values.resize(std::size_t{3} * n_faces_);
  for (std::uint32_t f = 0; f < n_faces_; ++f)
    std::fill(group_of() + begin(f), group_of() + end(f), value(normal_[f].x, normal_[f].y, normal_[f].z));
  mesh_.normal.values.resize(std::size_t{3} * n_values_);
}

/// Values take the place of the sums: there are never more of them.
void Normals::emit_groups() {
  std::uint32_t *group = group_of(), *groups = scratch_.groups.data(), n_groups = 0;
  for (std::uint32_t f = 0; f < n_faces_; ++f) {
    for (std::uint32_t c = begin(f), last = end(f); c < last; ++c) {
      std::uint32_t g = group[c];
      if (g == n_groups) {  // the first corner of its group
        const float* v = mesh_.normal.values.data() + std::size_t{3} * g;
        groups[g] = groups[g] ? unit_value(v, normal_[f]) : value(v[0], v[1], v[2]);
        ++n_groups;
      }
      group[c] = groups[g];
    }
  }
  mesh_.normal.values.resize(std::size_t{3} * n_values_);
}

std::uint32_t Normals::unit_value(const float* sum, const FaceNormal& otherwise) {
  double x = sum[0], y = sum[1], z = sum[2], square = x * x + y * y + z * z;
  if (!(square > cancelled)) return value(otherwise.x, otherwise.y, otherwise.z);
  double scale = 1 / std::sqrt(square);
  return value(static_cast<float>(x * scale) + 0.f, static_cast<float>(y * scale) + 0.f,
               static_cast<float>(z * scale) + 0.f);
}

/// Index of a value, the same for equal ones that lie not too far apart. `recent` is never cleared: an entry of an
/// earlier mesh either names no value of this one, or a different value, since an equal one would have taken its place.
std::uint32_t Normals::value(float x, float y, float z) {
  float* values = mesh_.normal.values.data();
  auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
  std::uint64_t h = (bits(x) * 0x9e3779b97f4a7c15u) ^ (bits(y) * 0xc2b2ae3d27d4eb4fu) ^ (bits(z) * 0x165667b19e3779f9u);
  std::uint32_t& r = recent_[(h ^ h >> 32) * 0x9e3779b97f4a7c15u >> 52];
  const float* old = values + std::size_t{3} * r;
  if (r < n_values_ && old[0] == x && old[1] == y && old[2] == z) return r;
  r = n_values_++;
  float* v = values + std::size_t{3} * r;
  v[0] = x;
  v[1] = y;
  v[2] = z;
  return r;
}

}  // namespace

void make_normals(Mesh& mesh, MeshScratch& scratch, double crease_angle) {
  mesh.normal.clear();
  mesh.normal.index.resize(mesh.corners.size());
  Normals(mesh, scratch).compute(crease_angle);
}

}  // namespace wrlkit

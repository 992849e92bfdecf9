// Faces are united to parts, and each knows whether it is wound like the first of its part or against it: a forest in
// which every link says which. No face is walked over twice, and where all is consistent, which is usual, no forest is
// planted at all.
#include "passes/weld/winding.h"

#include <algorithm>

namespace wrlkit {
namespace {

constexpr std::uint32_t no_normal = 0xffffffffu;

bool against(const Surface& s, const SurfaceEdge& e) {
  return e.manifold() && s.mesh.corners[e.first] == s.mesh.corners[e.second];
}

/// Six times the signed volume between a face and the first point.
double volume(const Surface& s, std::uint32_t f) { return dot(s.area_vector(f), s.point(s.face(f)[0]) - s.point(0)); }

}  // namespace

void Winding::unify(const Surface& s, const std::vector<SurfaceEdge>& edges, bool outward) {
  bool consistent = std::none_of(edges.begin(), edges.end(), [&](const SurfaceEdge& e) { return against(s, e); });
  if (consistent && !outward) return;
  unite(s, edges);
  sum_up(s, edges);
  for (std::uint32_t f = 0; f < s.n_faces(); ++f)
    if (links_[f] >> 1 == f) decide(parts_[f], s.mesh.ccw, outward);
  opposite_.assign(s.mesh.normal.present() ? s.mesh.normal.count() : 0, no_normal);
  for (std::uint32_t f = 0; f < s.n_faces(); ++f) {
    Member p = find(f);
    if (parts_[p.root].flip[p.against]) flip(s, f);
  }
}

void Winding::unite(const Surface& s, const std::vector<SurfaceEdge>& edges) {
  links_.resize(s.n_faces());
  for (std::uint32_t f = 0; f < s.n_faces(); ++f) links_[f] = 2 * f;
  conflicts_.clear();
  for (const SurfaceEdge& e : edges) {
    if (!e.manifold()) continue;
    Member a = find(s.face_of[e.first]), b = find(s.face_of[e.second]);
    std::uint32_t differ = a.against ^ b.against ^ (against(s, e) ? 1 : 0);
    if (a.root == b.root && differ)
      conflicts_.push_back(a.root);
    else
      links_[std::max(a.root, b.root)] = 2 * std::min(a.root, b.root) + differ;
  }
}

Winding::Member Winding::find(std::uint32_t f) {
  for (std::uint32_t way = 0;;) {
    std::uint32_t link = links_[f], before = link >> 1;
    if (before == f) return {f, way};
    std::uint32_t farther = links_[f] = links_[before] ^ (link & 1);
    way ^= farther & 1;
    f = farther >> 1;
  }
}

void Winding::sum_up(const Surface& s, const std::vector<SurfaceEdge>& edges) {
  parts_.assign(s.n_faces(), Part{});
  for (std::uint32_t f = 0; f < s.n_faces(); ++f) {
    Member p = find(f);
    Part& part = parts_[p.root];
    ++part.n_faces[p.against];
    part.n_corners += static_cast<std::uint32_t>(s.face(f).size());
    part.volume += (p.against ? -1 : 1) * volume(s, f);
  }
  for (const SurfaceEdge& e : edges)
    if (e.manifold()) ++parts_[find(s.face_of[e.first]).root].n_edges;
  for (std::uint32_t f : conflicts_) parts_[find(f).root].one_sided = true;
}

void Winding::decide(Part& part, bool ccw, bool outward) {
  if (part.one_sided) {
    ++counts.one_sided_parts;
    return;
  }
  bool closed = 2 * std::size_t{part.n_edges} == part.n_corners && part.volume != 0;
  bool inside_out = (part.volume < 0) == ccw;
  bool tie = part.n_faces[0] == part.n_faces[1];
  bool turn_first = closed && (outward || tie) ? inside_out : part.n_faces[0] < part.n_faces[1];
  part.flip[0] = turn_first;
  part.flip[1] = !turn_first;
  counts.flipped_faces += part.n_faces[turn_first ? 0 : 1];
}

/// The first corner stays the first.
void Winding::flip(const Surface& s, std::uint32_t f) {
  if (s.mesh.normal.present()) flip_normals(s, f);
  for_each_stream(s.mesh, [&](std::vector<std::uint32_t>& stream) {
    std::reverse(stream.begin() + s.begin(f) + 1, stream.begin() + s.end(f));
  });
}

/// Normals that were right while the face was not are left alone.
void Winding::flip_normals(const Surface& s, std::uint32_t f) {
  Attribute& normal = s.mesh.normal;
  const Vec3 front = (s.mesh.ccw ? 1 : -1) * s.area_vector(f);
  for (std::uint32_t c = s.begin(f); c < s.end(f); ++c) {
    std::uint32_t i = normal.index[c];
    const float n[3] = {normal.at(i)[0], normal.at(i)[1], normal.at(i)[2]};
    if (!(n[0] * front[0] + n[1] * front[1] + n[2] * front[2] > 0)) continue;
    if (opposite_[i] == no_normal) {
      opposite_[i] = static_cast<std::uint32_t>(normal.count());
      for (float x : n) normal.values.push_back(0 - x);
    }
    normal.index[c] = opposite_[i];
  }
}

}  // namespace wrlkit

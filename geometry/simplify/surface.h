// The surface that edges are collapsed on: flat arrays of 32-bit indices. A face knows its three vertices, a vertex the
// list of its faces; there are no half-edges, and any number of faces may share an edge or a vertex. Edges that must be
// kept as lines (features) are three bits in each of their faces.
//
// Lists of faces lie in one pool. Removing a face marks it dead; lists are purged when they are walked next.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/math/vec.h"
#include "geometry/mesh.h"

namespace wrlkit::simplify {

constexpr std::uint32_t none = 0xffffffffu;

/// What a vertex is by the feature edges that meet there. Where the surface touches itself in a vertex, that is
/// `fixed`.
enum class Kind : std::uint8_t { free, line, corner, fixed };

/// The faces around one vertex, and the edges that lead away from it.
struct Ring {
  static constexpr int max_faces = 96;  // a vertex of more is left alone until its neighbours have gone

  struct Face {
    std::uint32_t face;
    std::uint8_t corner;      // which of its corners is the centre
    std::uint8_t next, prev;  // spokes of the two others, in the face's order
  };
  struct Spoke {
    std::uint32_t vertex;
    std::uint8_t n_faces;
    bool feature, crease;
  };

  std::uint32_t center = none;
  int n_faces = 0, n_spokes = 0;
  Face faces[max_faces];
  Spoke spokes[2 * max_faces];

  std::span<const Face> face_span() const { return {faces, static_cast<std::size_t>(n_faces)}; }
  std::span<const Spoke> spoke_span() const { return {spokes, static_cast<std::size_t>(n_spokes)}; }
  std::uint32_t next_vertex(const Face& f) const { return spokes[f.next].vertex; }
  std::uint32_t prev_vertex(const Face& f) const { return spokes[f.prev].vertex; }
  /// Whether the face has that vertex next to the centre.
  bool has(const Face& f, std::uint32_t vertex) const { return next_vertex(f) == vertex || prev_vertex(f) == vertex; }
  /// -1: no such edge.
  int find(std::uint32_t vertex) const {
    for (int i = 0; i < n_spokes; ++i)
      if (spokes[i].vertex == vertex) return i;
    return -1;
  }
};

class Surface {
 public:
  struct Triangle {
    std::uint32_t v[3];
    std::uint8_t features;  // bit k: the edge from corner k to the next is a line; bit k + 3: it is a crease
  };
  /// What is needed of a vertex together lies together: a miss of the cache costs more than to price an edge.
  struct Vertex {
    Vec3 position;
    std::uint32_t begin, size, capacity;  // its list in the pool
    std::uint32_t degree;                 // the faces of the list that are alive
    Kind kind, crease_kind;               // the latter if creases were lines too
    bool open;                            // at an edge of other than two faces
  };

  /// Takes the triangles of a mesh; vertices are numbered as the corners first use them.
  explicit Surface(const Mesh& mesh);

  std::uint32_t n_vertices() const { return static_cast<std::uint32_t>(vertex.size()); }
  std::uint32_t n_slots() const { return static_cast<std::uint32_t>(face.size()); }
  std::size_t n_faces() const { return n_live_; }
  bool alive(std::uint32_t f) const { return face[f].v[0] != none; }
  std::uint32_t degree(std::uint32_t v) const { return vertex[v].degree; }
  std::uint32_t original(std::uint32_t v) const { return original_[v]; }
  /// `none` when no corner uses that position.
  std::uint32_t vertex_of(std::uint32_t original) const;

  /// False when the vertex has too many faces, or none.
  bool gather(std::uint32_t v, Ring& ring);
  bool feature(const Ring::Face& f, bool towards_next) const {
    return face[f.face].features >> (towards_next ? f.corner : (f.corner + 2) % 3) & 1;
  }
  /// Twice the area, along the normal.
  Vec3 normal(std::uint32_t f) const {
    const Triangle& t = face[f];
    const Vec3& a = vertex[t.v[0]].position;
    return cross(vertex[t.v[1]].position - a, vertex[t.v[2]].position - a);
  }

  /// Another face with these two vertices, the first in the list of `a`; none when there is none.
  std::uint32_t across(std::uint32_t f, std::uint32_t a, std::uint32_t b) const;

  /// Sets the kind by the features of its spokes.
  void classify(const Ring& ring);

  /// Removes the faces at the edge between the two and hands the others of `from` to `to`.
  void merge(const Ring& from, const Ring& to);

  const Vec3& position(std::uint32_t v) const { return vertex[v].position; }

  std::vector<Vertex> vertex;
  std::vector<Triangle> face;  // dead: vertex 0 is none

 private:
  void make_lists();
  void store(std::uint32_t v, const std::uint32_t* faces, std::uint32_t n);
  void remove(std::uint32_t f);

  std::vector<std::uint32_t> pool_;
  std::vector<std::uint32_t> original_;
  std::size_t n_live_ = 0;
  std::size_t pool_used_ = 0;
};

}  // namespace wrlkit::simplify

// Geometry as the passes see it: polygons of corners, one index stream per attribute, positions shared. VRML gives each
// of coord, normal, color and texCoord its own index; that is kept, because a seam that was split early is found by no
// later pass. A Mesh is made from a geometry node (geometry/geometry.h), changed by mesh passes, and either stored back
// as an IndexedFaceSet or split into single-index vertices for glTF.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/math/box.h"
#include "scenegraph/ids.h"

namespace wrlkit {

/// An array that is either borrowed (from the arena of a scene, which outlives it) or its own. Reading is the same;
/// `edit` copies a borrowed one first.
template <class T>
class Array {
 public:
  Array() = default;
  Array(const Array& o) : own_(o.own_), view_(o.view_) {}
  Array(Array&& o) noexcept { *this = std::move(o); }
  Array& operator=(const Array& o) { return *this = Array(o); }
  Array& operator=(Array&& o) noexcept {
    own_ = std::move(o.own_);
    view_ = o.view_;
    o.clear();
    return *this;
  }

  static Array borrow(std::span<const T> s) {
    Array a;
    a.view_ = s;
    return a;
  }
  std::span<const T> span() const { return borrowed() ? view_ : std::span<const T>(own_); }
  std::size_t size() const { return span().size(); }
  bool empty() const { return size() == 0; }
  const T& operator[](std::size_t i) const { return span()[i]; }
  const T* data() const { return span().data(); }
  std::vector<T>& edit() {
    if (borrowed()) {
      own_.assign(view_.begin(), view_.end());
      view_ = {};
    }
    return own_;
  }
  /// Empty and owned; the memory is kept for the next use.
  void clear() {
    own_.clear();
    view_ = {};
  }

 private:
  bool borrowed() const { return !view_.empty(); }
  std::vector<T> own_;
  std::span<const T> view_;  // of a borrowed array only
};

/// Values of `width` floats each, and for each corner of the mesh which of them it takes. Absent when `index` is empty.
struct Attribute {
  std::vector<float> values;
  std::vector<std::uint32_t> index;  // one per corner
  int width;

  explicit Attribute(int w = 3) : width(w) {}

  bool present() const { return !index.empty(); }
  std::size_t count() const { return values.size() / width; }
  const float* at(std::uint32_t i) const { return values.data() + std::size_t{i} * width; }
  void clear() {
    values.clear();
    index.clear();
  }
};

struct Mesh {
  enum class Kind : std::uint8_t { none, faces, lines, points };

  Kind kind = Kind::none;
  Array<double> positions;                // xyz, metres of the local frame
  std::vector<std::uint32_t> corners;     // position of each corner; of points: one corner each
  std::vector<std::uint32_t> face_begin;  // first corner of each face or polyline, and the end; n + 1. Empty: triangles
                                          // (kind faces), segments (kind lines) or single corners (kind points)
  std::vector<std::uint32_t> cut;  // how many triangles each face became that was cut, in order; empty: none was, or
                                   // a pass has changed them since
  Attribute normal{3}, color{3}, texcoord{2};
  Attribute lightcoord{2};  // places in a lightmap

  // What IndexedFaceSet says of its faces (ISO/IEC 14772-1, 6.23).
  bool ccw = true, solid = true, convex = true;
  double crease_angle = 0;  // radians
  bool primitive = false;   // made from Box, Cone, ...: normals and texture coordinates are exact already

  /// For what is done to all of them alike.
  std::array<Attribute*, 4> attributes() { return {&normal, &color, &texcoord, &lightcoord}; }
  std::array<const Attribute*, 4> attributes() const { return {&normal, &color, &texcoord, &lightcoord}; }

  std::size_t n_positions() const { return positions.size() / 3; }
  Vec3 position(std::uint32_t i) const { return vec3(&positions[std::size_t{3} * i]); }
  std::size_t corners_per_face() const { return kind == Kind::faces ? 3 : kind == Kind::lines ? 2 : 1; }
  std::size_t n_faces() const {
    return face_begin.empty() ? corners.size() / corners_per_face() : face_begin.size() - 1;
  }
  std::size_t begin_of(std::size_t face) const {
    return face_begin.empty() ? face * corners_per_face() : face_begin[face];
  }
  std::size_t end_of(std::size_t face) const {
    return face_begin.empty() ? (face + 1) * corners_per_face() : face_begin[face + 1];
  }
  bool is_triangles() const { return kind == Kind::faces && face_begin.empty(); }

  /// Back to nothing; memory is kept, so that one Mesh can serve a million shapes.
  void clear() {
    kind = Kind::none;
    positions.clear();
    corners.clear();
    face_begin.clear();
    cut.clear();
    for (Attribute* a : attributes()) a->clear();
    color.width = 3;
    ccw = solid = convex = true;
    crease_angle = 0;
    primitive = false;
  }
};

/// Of the positions that corners use. O(corners).
inline Box box_of_corners(const Mesh& mesh) {
  Box box;
  for (auto c : mesh.corners) box.add(mesh.position(c));
  return box;
}

/// Gives the mesh of a geometry node, as the passes leave it: corner-indexed, kind none when there is nothing to draw.
/// The reference is good until the next call. How a writer or the renderer pulls geometry one at a time, so that the
/// meshes of a plant never lie in memory all together.
using MeshSource = std::function<const Mesh&(NodeId geometry)>;

/// Slot of each of many sparse keys below some bound, in O(1), without clearing an array of that bound for every use:
/// what lets one face of a Shape that re-uses a point list of millions cost one face and not millions.
class StampedMap {
 public:
  /// Forgets everything; keys below `bound` may be used. Amortised O(1).
  void reset(std::size_t bound) {
    if (stamp_.size() < bound) {
      stamp_.resize(bound, 0);
      value_.resize(bound);
    }
    if (++now_ == 0) {
      std::fill(stamp_.begin(), stamp_.end(), 0u);
      now_ = 1;
    }
  }
  bool contains(std::size_t key) const { return stamp_[key] == now_; }
  std::uint32_t operator[](std::size_t key) const { return value_[key]; }
  void set(std::size_t key, std::uint32_t v) {
    stamp_[key] = now_;
    value_[key] = v;
  }

 private:
  std::vector<std::uint32_t> stamp_, value_;
  std::uint32_t now_ = 0;
};

}  // namespace wrlkit

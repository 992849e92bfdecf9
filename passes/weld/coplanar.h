// Faces in one plane, united to polygons: the way back from what a tessellator cut up.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/polygon.h"
#include "passes/weld/edges.h"
#include "passes/weld/surface.h"

namespace wrlkit {

class CoplanarMerger {
 public:
  /// Unites faces across manifold edges where the points lie in the plane of the first, to within the tolerance or the
  /// precision of single numbers, and all attributes are linear. The polygons are simple and without holes; the mesh
  /// becomes `convex FALSE` when one of them is not convex. Returns how many faces fewer there are; edges are out of
  /// date then. Linear except for large concave polygons.
  std::size_t merge(const Surface&, const std::vector<SurfaceEdge>&, double tolerance, StampedMap&);

 private:
  /// The plane of a region, and three corners there that say what the attributes are everywhere in it.
  struct Frame {
    Vec3 origin, normal, u, v;  // u and v from the origin to the other two; normal of length 1
    double uu, uv, vv;
    std::uint32_t corners[3];
    bool good;
  };

  void prepare(const Surface&, const std::vector<SurfaceEdge>&, StampedMap&);
  Frame frame_of(const Surface&, std::uint32_t face) const;
  void grow(const Surface&, std::uint32_t seed);
  void add(const Surface&, std::uint32_t seed, std::uint32_t face);
  bool fits(const Surface&, const Frame&, std::uint32_t face) const;
  bool linear(const Attribute&, const Frame&, double s, double t, std::uint32_t corner) const;
  bool keeps_disk(const Surface&, std::uint32_t seed, std::uint32_t face) const;
  bool inside(const Surface& s, std::uint32_t seed, std::uint32_t corner) const {
    return mate_[corner] != none && region_[s.face_of[mate_[corner]]] == seed;
  }
  bool outline(const Surface&, std::uint32_t seed);
  void note_concave(const Surface&, const Vec3& normal);

  static constexpr std::uint32_t none = 0xffffffffu;

  double near_ = 0;                      // distance from the plane
  std::vector<std::uint32_t> mate_;      // of each corner whose edge has two sides: the corner on the other
  std::vector<char> simple_;             // by face: no point twice
  std::vector<std::uint32_t> region_;    // of each face: the first face of its region
  std::vector<std::uint32_t> point_in_;  // of each point: the region that came there last
  std::vector<std::uint32_t> members_, queue_;
  std::vector<std::uint32_t> corners_, face_begin_, room_;  // of the result
  bool concave_ = false;
  PolygonCutter cutter_;
};

}  // namespace wrlkit

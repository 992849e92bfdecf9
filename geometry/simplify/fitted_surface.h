// A coarse surface that is fitted to points of a fine one while its edges collapse (Hoppe, DeRose, Duchamp, McDonald,
// Stuetzle: Mesh Optimization, 1993): for the last hundred triangles of a part, where what a collapse costs is measured
// and not estimated, and where topology is free: a tube may become a strip, a cap that nobody misses goes.
#pragma once
#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "geometry/closest_point.h"
#include "geometry/simplify/samples.h"
#include "geometry/simplify/surface.h"

namespace wrlkit::simplify {

/// Vertices and triangles, without anything else.
struct PlainMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

class FittedSurface {
 public:
  /// `original` and `samples`, which are of the same surface, must outlive this. O(n log n).
  FittedSurface(PlainMesh mesh, const ClosestPoint& original, std::span<const SurfaceSample> samples);

  std::size_t n_faces() const { return n_faces_; }
  /// Does what adds least to the squared distances for each triangle that it saves. False when nothing may be done.
  bool step();
  /// Moves the vertices to where the squares of the distances of the samples are least, and assigns these once more.
  void refine();
  /// Integrals of the squared distance over both surfaces, and the largest distance of a sample.
  Distortion distortion() const;
  /// Triangles that are left, with the vertices that they use.
  PlainMesh mesh() const;

 private:
  using Face = std::array<std::uint32_t, 3>;
  struct Nearest {
    double squared = 0;
    std::array<double, 3> at{};  // barycentric
  };
  struct Entry {
    double key;
    std::uint32_t from, to;  // equal: the face of that number goes
    std::uint32_t stamp;
    bool operator<(const Entry& o) const { return key > o.key; }
  };
  /// What is left of the faces around two vertices that become one.
  struct Merged {
    std::vector<Face> faces;
    std::vector<std::uint32_t> old, slots;  // the faces before, and the old slot of each new one
    std::vector<std::uint32_t> samples;
    Vec3 position;
    double cost = 0;
  };

  void list_faces();
  void assign_all();
  void enqueue_edge(std::uint32_t u, std::uint32_t v);
  void enqueue_face(std::uint32_t f);
  std::uint32_t stamp_of(const Entry& e) const;
  bool gather(std::uint32_t u, std::uint32_t v, Merged& m) const;
  /// What is known at once is less than the whole price, which asks the way back, too.
  enum class Price : bool { at_least, whole };
  bool evaluate(std::uint32_t u, std::uint32_t v, Price price, Merged& m) const;
  bool turns_over(const Merged& m, std::uint32_t u, std::uint32_t v) const;
  double forward(const Merged& m, std::uint32_t v, const Vec3& x, std::size_t stride, Vec3* better) const;
  std::array<Vec3, 3> corners_of(const Face& f, std::uint32_t v, const Vec3& x) const;
  double backward(const std::array<Vec3, 3>& corners) const;
  std::optional<double> price_of_removal(std::uint32_t f) const;
  void merge(std::uint32_t u, std::uint32_t v, const Merged& m);
  void remove(std::uint32_t f);
  void assign(std::span<const std::uint32_t> samples, std::span<const std::uint32_t> faces);
  void unlink(std::uint32_t f);
  std::vector<std::uint32_t> around(std::uint32_t f) const;
  double cost_of(std::uint32_t sample, double squared) const;

  const ClosestPoint& original_;
  std::span<const SurfaceSample> samples_;
  std::vector<Vec3> position_;
  std::vector<Face> face_;
  std::vector<char> alive_;
  std::vector<double> backward_;                        // of each face
  std::vector<std::vector<std::uint32_t>> faces_of_;    // of each vertex
  std::vector<std::vector<std::uint32_t>> samples_of_;  // of each face
  std::vector<double> squared_;                         // distance of each sample
  std::vector<std::uint32_t> stamp_, face_stamp_;
  std::priority_queue<Entry> queue_;
  std::size_t n_faces_ = 0;
  double spacing_ = 0;
  mutable std::uint32_t guess_ = ClosestPoint::no_guess;
};

}  // namespace wrlkit::simplify

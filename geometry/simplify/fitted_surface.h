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
#include "geometry/simplify/nearest_faces.h"
#include "geometry/simplify/samples.h"
#include "geometry/simplify/surface.h"

namespace wrlkit::simplify {

/// Vertices and triangles, without anything else but the regions of the triangles where the surface has some.
struct PlainMesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::uint32_t> regions;
};

class FittedSurface {
 public:
  /// `samples` are of the original; what both look at must outlive this. Where the original has regions, a sample is
  /// near to faces of its own: to others it is as much farther as it is deep in its region. O(n log n).
  FittedSurface(PlainMesh mesh, const Original& original, std::span<const SurfaceSample> samples);

  std::size_t n_faces() const { return n_faces_; }
  /// Does what adds least to the squared distances for each triangle that it saves. False when nothing may be done.
  bool step();
  /// Moves the vertices to where the squares of the distances of the samples are least, and assigns these once more;
  /// so many times.
  void refine(int rounds);
  /// Integrals of the squared distance over both surfaces, and the largest one.
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
    std::uint32_t stamp;     // of a face
    bool operator<(const Entry& o) const { return key > o.key; }
  };
  /// What is left of the faces around two vertices that become one.
  struct Merged {
    std::vector<Face> faces;
    std::vector<std::uint32_t> old, slots;  // the faces before, and the old slot of each new one
    std::vector<std::uint32_t> samples;
    std::vector<double> backward;  // of each new face, when the whole price was asked
    Vec3 position;
    double cost = 0;

    void clear();
  };

  void list_faces();
  void assign_all();
  void assign_again();
  void measure_backward();
  Vec3 within_reach(const Vec3& x) const;
  void enqueue_all();
  bool next_step();
  void enqueue_edge(std::uint32_t u, std::uint32_t v);
  void enqueue_face(std::uint32_t f);
  bool has_edge(std::uint32_t u, std::uint32_t v) const;
  bool gather(std::uint32_t u, std::uint32_t v);
  bool evaluate(std::uint32_t u, std::uint32_t v);
  void ask(std::size_t most, const Vec3& origin);
  double forward(std::uint32_t v, const Vec3& x, std::size_t n, Vec3* better);
  bool turns_over(std::uint32_t u, std::uint32_t v) const;
  double key_of_merged() const;
  std::array<Vec3, 3> corners_of(const Face& f, std::uint32_t v, const Vec3& x) const;
  double backward(const std::array<Vec3, 3>& corners, std::uint32_t region, Distortion* all = nullptr) const;
  std::uint32_t region_of(std::uint32_t face) const {
    return region_.empty() ? ClosestOfLabel::no_label : region_[face];
  }
  void add_point(std::uint32_t sample);
  void list_regions(std::span<const std::uint32_t> faces);
  void assign_by_regions(std::span<const double> positions);
  std::optional<double> price_of_removal(std::uint32_t f);
  void merge(std::uint32_t u, std::uint32_t v);
  void remove(std::uint32_t f);
  bool step_of_edge(const Entry& e);
  void assign(std::span<const std::uint32_t> samples, std::span<const std::uint32_t> faces);
  void unlink(std::uint32_t f);
  std::vector<std::uint32_t> around(std::uint32_t f) const;
  double cost_of(std::uint32_t sample, double squared) const;

  Original original_;
  std::span<const SurfaceSample> samples_;
  std::vector<Vec3> position_;
  std::vector<Face> face_;
  std::vector<std::uint32_t> region_;  // of each face; empty without any
  std::vector<char> alive_;
  std::vector<double> backward_;                        // of each face
  std::vector<std::vector<std::uint32_t>> faces_of_;    // of each vertex
  std::vector<std::vector<std::uint32_t>> samples_of_;  // of each face
  std::vector<double> squared_;                         // distance of each sample
  std::vector<std::uint32_t> face_stamp_;
  std::priority_queue<Entry> queue_;
  std::size_t n_faces_ = 0, n_enqueued_ = 0;  // there are; there were when all steps were priced
  double spacing_ = 0;
  double reach_ = 0;         // how far a vertex may be from the original
  Distortion backward_all_;  // when it was measured last
  mutable std::uint32_t guess_ = ClosestPoint::no_guess;
  // Of the question at hand.
  Merged merged_;
  std::vector<std::uint32_t> asked_;  // samples
  double stands_for_ = 1;             // samples for each of them
  PointBatch points_;
  std::vector<std::array<Vec3, 3>> corners_;
  std::vector<std::uint32_t> regions_;  // of these; empty without any
};

}  // namespace wrlkit::simplify

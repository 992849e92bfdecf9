// Is one mesh another one, moved? Found by vertices, not by principal axes: a cube or a bolt has any number of those.
//
// First the corners are taken in the order in which they stand, as exporters write copies. Where that fails, a frame is
// laid through two corners of the first mesh, chosen such that few others are like them, and through each pair of the
// second that could be theirs; a body with symmetries takes the first. Either way every corner of every face is
// compared in the end.
#pragma once
#include <optional>

#include "passes/instance/motion.h"

namespace wrlkit::instancing {

struct MatchOptions {
  Scaling scaling = Scaling::uniform;
  bool mirror = false;
  double tolerance = 0;  // how far a corner may be from where it should be, in units of the second mesh
};

/// The faces of a form by where they are, for one comparison after the other.
class FaceGrid {
 public:
  /// `near`: what is looked for is at most that far from where it is.
  void build(const MeshForm& form, double near);
  /// Calls f(face) for each that may have its centre there until it returns true; no more than `most` of them.
  template <class F>
  bool any_near(const Vec3& at, F&& f) const;
  double near() const { return near_; }

 private:
  struct Entry {
    std::uint64_t cell;
    std::uint32_t face;
  };
  std::uint64_t cell(const Vec3& at, int dx, int dy, int dz) const;
  static constexpr int most = 64;
  std::vector<Entry> entries_;
  double near_ = 0;
};

class Matcher {
 public:
  explicit Matcher(const MatchOptions& options) : options_(options) {}

  /// The Transform from `from` to `to`; none when there is none that brings every corner, with its normal, colour and
  /// texture coordinate, to its counterpart. O(corners), and n log n if their order differs.
  std::optional<TransformFields> match(const MeshForm& from, const MeshForm& to);

 private:
  /// For each corner of `from` the one of `to`.
  using Pairs = std::vector<std::uint32_t>;

  std::optional<TransformFields> in_order();
  std::optional<TransformFields> by_frames();
  std::optional<TransformFields> settle(const Pairs& pairs, bool mirrored);
  bool agree(const Matrix& m, const Pairs& pairs) const;
  bool agree_in_attributes(const Matrix& normal, std::uint32_t a, std::uint32_t b) const;
  bool choose_base();
  std::optional<TransformFields> try_frame(const Vec3& p, const Vec3& q, bool mirrored);
  bool pair_faces(const Matrix& linear, bool mirrored);
  bool pair_face(std::size_t a, std::size_t b, const Matrix& linear, bool mirrored);

  MatchOptions options_;
  const MeshForm *from_ = nullptr, *to_ = nullptr;
  std::uint32_t base_[2]{};
  bool line_ = false;  // all corners lie on one line through the centre
  double factor_ = 1;  // to over from, in the search by frames
  FaceGrid grid_;
  std::vector<char> taken_;
  Pairs pairs_;
  int attempts_ = 0;
};

}  // namespace wrlkit::instancing

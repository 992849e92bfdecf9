// Colours of whole faces: where two of them meet is seen as sharply as the form is.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace wrlkit {

/// The colour of a face of a mesh of triangles as four bytes, if its corners have the same one.
std::optional<std::uint32_t> flat_color(const Mesh& mesh, std::size_t face);

/// Colours are the same region that differ in no bit of this.
using ColorMask = std::uint32_t;
constexpr ColorMask all_colors = 0xffffffffu;
/// Of those with one bit less of each component.
constexpr ColorMask coarser(ColorMask mask) { return mask & (mask << 1) & 0xfefefefeu; }

/// The regions of a mesh of triangles that have one colour each. Colours are told apart by the 256 steps of a display;
/// where there are more than `most_regions`, by fewer.
class FlatColors {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;
  static constexpr std::size_t most_regions = 64;

  /// Nothing unless each face has one colour, and not all of them the same. Colours of vertices are such colours when
  /// most faces have only one, and the others, where two regions meet, none of their own: these count for the colour
  /// that most of their corners have. O(n log n).
  static std::optional<FlatColors> of(const Mesh& mesh);

  std::uint32_t n_regions() const { return static_cast<std::uint32_t>(colors_.size()); }
  /// Whether some faces have several colours.
  bool blends() const { return blends_; }
  /// Of each face.
  std::span<const std::uint32_t> regions() const { return regions_; }
  /// Of each face of another mesh, by its colour; none where it has not one of these. O(n log n).
  std::vector<std::uint32_t> regions_of(const Mesh& mesh) const;
  /// Gives each face the colour of a region.
  void paint(Mesh& mesh, std::span<const std::uint32_t> regions) const;

 private:
  using Color = std::array<float, 4>;

  int width_ = 3;
  bool blends_ = false;
  ColorMask mask_ = all_colors;
  std::vector<std::uint32_t> regions_;
  std::vector<Color> colors_;  // of the regions
  std::map<std::uint32_t, std::uint32_t> number_;
};

/// A mesh whose colours blend where regions meet, with a colour for each face: what is simplified must not blend them
/// over more. Nothing when there are no regions, or they do not blend.
std::optional<Mesh> with_whole_faces(const Mesh& mesh);

}  // namespace wrlkit

// The colours of a coarse tile: what has one is as far from the full tiles as from what has the same one there.
#pragma once
#include <map>
#include <set>
#include <span>

#include "convert/tiles/soup.h"
#include "geometry/flat_colors.h"

namespace wrlkit::tiles {

/// The first region is all that has no colours for whole faces; each of the others is a colour.
class ColorRegions {
 public:
  /// Of pieces each face of which has one colour, as far as these are among `full`: the others do not count.
  ColorRegions(std::span<const Piece> coarse, const std::set<std::uint32_t>& full);

  std::size_t size() const { return number_.size() + 1; }
  /// Triangles of the coarse tile; each is in one region.
  Soup coarse(std::size_t region, std::span<const Piece> pieces, const Vec3& origin) const;
  /// Triangles of a full tile that those of a region may be near to.
  Soup full(std::size_t region, std::span<const Piece> pieces, const Vec3& origin) const;

 private:
  std::size_t of(const Mesh& mesh, std::size_t triangle) const;

  ColorMask mask_ = all_colors;
  std::map<std::uint32_t, std::size_t> number_;
  std::set<const Piece*> colored_;  // of the coarse tile
};

/// Colours of faces that have one, all of them.
void add_flat_colors(std::span<const Piece> pieces, std::set<std::uint32_t>& to);

}  // namespace wrlkit::tiles

// Which texels a triangle on a page covers, and from which points of the surface each texel is lit.
//
// A texel stands for the square around its centre: it is lit from those of `side` x `side` points in a regular grid
// over that square that lie on a triangle, so that a texel which a shadow's edge or the border of a chart cuts has the
// mean of what it shows. A texel that is only grazed, between the points of the grid, is lit from the nearest point of
// the triangle: the four texels that a bilinear filter mixes at the border of a chart then all have light.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace wrlkit::bake {

struct Spot2 {
  float x, y;  // texels
};

/// A triangle on a page; its corners run clockwise where its Shape is mirrored.
struct PlacedTriangle {
  Spot2 corner[3];
  std::uint32_t chart;
};

/// A point of the surface: a triangle and the weights of its corners.
struct SurfaceSample {
  std::uint32_t triangle;
  float weight[3];
};

/// A covered texel and its samples, into TileTexels::samples.
struct TexelSamples {
  int x, y;
  std::uint32_t first, count;
};

struct TileTexels {
  std::vector<TexelSamples> texels;
  std::vector<SurfaceSample> samples;
};

/// Triangles of a page, sorted into square tiles, so that work goes tile by tile and its memory does not grow with the
/// page.
class TexelGrid {
 public:
  static constexpr int tile = 64;  // texels

  /// `triangles` must outlive it. O(triangles + the tiles that each one meets).
  TexelGrid(std::span<const PlacedTriangle> triangles, int width, int height);

  std::size_t n_tiles() const { return std::size_t(columns_) * rows_; }
  /// Covered texels of a tile, row by row; at most `most` samples each, spread over those that there are. Of triangles
  /// of several charts in one texel the first chart has it. `out` is cleared first.
  void texels_of(std::size_t tile, int side, int most, TileTexels& out) const;

 private:
  std::span<const PlacedTriangle> triangles_;
  int width_, height_, columns_, rows_;
  std::vector<std::uint32_t> first_;    // of the triangles of each tile
  std::vector<std::uint32_t> members_;  // triangles, in order
};

}  // namespace wrlkit::bake

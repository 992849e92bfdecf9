// Where everything lies on the pages: the charts of the parts, placed for each Shape that shows one.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/unwrap/pack.h"
#include "passes/lightmap/parts.h"
#include "passes/lightmap/seams.h"
#include "passes/lightmap/texels.h"

namespace wrlkit::bake {

struct LayoutOptions {
  double density = 0;  // texels per metre; 0: as many as fit on one page of `side`
  int side = 2048;     // of that page, or the largest of a page
  int mips = 0;  // versions of a page, each half of the one before, that keep charts apart: 2^mips + 2 texels between
                 // them. 0: up to four, as many as cost no more than a tenth of the texels a metre
};

/// Which triangle of which part a placed triangle is, and whose.
struct FacetRef {
  std::uint32_t part, triangle, use;
};

struct PageLayout {
  int width = 0, height = 0;
  std::vector<PlacedTriangle> triangles;
  std::vector<FacetRef> refs;  // of each of them
};

/// How the charts of a part become places in a Shape's page: lightCoord is turned by quarters and moved, in units of
/// `unit` texels, then divided by the page's sides.
struct ShapePlace {
  std::uint32_t page = 0;
  bool own_coords = true;  // lightCoord is the place on the page already
  int quarter_turns = 0;
  double x = 0, y = 0, unit = 1;  // texels
};

class Layout {
 public:
  Layout(const std::vector<Part>& parts, const LayoutOptions& options);

  const std::vector<PageLayout>& pages() const { return pages_; }
  /// Texels per metre.
  double density() const { return density_; }
  /// What did not get as many as were asked for.
  struct Coarse {
    std::size_t n_shapes = 0;
    double least = 0;  // texels per metre, relative to the wish
  };
  Coarse coarse() const;
  /// Of use `k` of a part.
  ShapePlace place(std::size_t part, std::size_t k) const;
  /// lightCoord of each corner of a part, xy.
  std::vector<float> coords(std::size_t part) const;
  /// The edges along which smooth surfaces are cut.
  std::vector<Seam> seams() const;

 private:
  unwrap::PackItem item(std::size_t part) const;
  double texels(std::size_t part) const;
  double possible_density() const;
  void place_all(int padding);
  int cheap_padding() const;
  void pack_all();
  void pack(std::size_t begin, std::size_t end, int side);
  void measure_pieces();
  void place_triangles();
  unwrap::Point2 in_item(std::size_t part, std::size_t corner) const;
  SeamSide side(std::size_t part, std::size_t k, std::uint32_t from, std::uint32_t to) const;

  const std::vector<Part>& parts_;
  LayoutOptions options_;
  int padding_ = 2;                        // texels between charts
  std::vector<unwrap::PackedItem> items_;  // of each part
  std::vector<double> piece_unit_;         // of a part with copies: the larger side of the piece, texels
  std::vector<PageLayout> pages_;
  double density_ = 1;
};

}  // namespace wrlkit::bake

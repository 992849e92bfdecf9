// The pictures of compare-lod as one picture.
#include <algorithm>

#include "tools/report/comparison.h"
#include "tools/report/picture_grid.h"

namespace wrlkit {
namespace {

constexpr std::size_t columns = 4;

}  // namespace

Image comparison_sheet(const Comparison& c) {
  std::size_t rows = 0, widest = 1;
  for (const auto& criterion : c.criteria) {
    rows += (criterion.pictures.size() + columns - 1) / columns;
    widest = std::max(widest, std::min(columns, criterion.pictures.size()));
  }
  const auto width = static_cast<std::size_t>(c.picture.width), height = static_cast<std::size_t>(c.picture.height);
  Image sheet{static_cast<int>(widest * width), static_cast<int>(std::max<std::size_t>(rows, 1) * height), 3, {}};
  sheet.pixels.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 3, 255);
  std::size_t row = 0;
  for (const auto& criterion : c.criteria) {
    for (std::size_t i = 0; i < criterion.pictures.size(); ++i)
      put(sheet, criterion.pictures[i], static_cast<int>(i % columns * width),
          static_cast<int>((row + i / columns) * height));
    row += (criterion.pictures.size() + columns - 1) / columns;
  }
  return sheet;
}

}  // namespace wrlkit

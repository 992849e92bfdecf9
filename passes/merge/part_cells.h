// Which Shapes without a name are better one mesh: those of one part that look alike, if their vertices take fewer
// bytes together than the nodes and meshes that they need apart.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace wrlkit {

struct PartItem {
  std::uint32_t group;  // only parts of one group go together
  std::uint32_t geometry, shape;
  std::uint32_t times;  // that the group is drawn
  double bytes;         // of its vertices in a merged mesh
};

/// Cells of two items and more, as numbers of items. A shape in several groups stays. n log n.
std::vector<std::vector<std::uint32_t>> part_cells(std::span<const PartItem> items);

}  // namespace wrlkit

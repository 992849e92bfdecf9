// Faces that are dropped: those without area, and those that are there already.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/weld/surface.h"

namespace wrlkit {

struct FaceCleaner {
  struct Counts {
    std::size_t degenerate_faces = 0, repeated_corners = 0, duplicate_faces = 0, duplicate_triangles = 0;
    std::size_t without_area = 0;  // of all that there were, dropped or not
  };

  /// Drops faces without area, and corners at the point of the one before; nothing where no face has an area. Linear.
  void drop_degenerate(const Surface&);
  /// Drops faces that have the points of an earlier one in the same order, wherever they start; with `both_ways` those
  /// in the opposite order too. Linear.
  void drop_duplicates(const Surface&, bool both_ways);

  Counts counts;

 private:
  void keep(const Surface&, std::vector<std::uint32_t>& corners, std::vector<std::uint32_t>& face_begin);

  std::vector<std::uint32_t> corners_, face_begin_, room_;
  std::vector<std::uint32_t> heads_, next_;
  std::vector<std::uint64_t> hashes_;
};

}  // namespace wrlkit

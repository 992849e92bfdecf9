// coordIndex and its like: runs of indices, each ended by -1 (ISO/IEC 14772-1, 6.23 and 6.24). A run is a face of an
// IndexedFaceSet or a polyline of an IndexedLineSet.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace wrlkit {

/// Calls f(first, last) for each run [first, last) of the list, empty ones included. The last -1 may be missing.
template <class F>
void for_each_run(std::span<const std::int32_t> list, F f) {
  for (std::size_t first = 0; first < list.size();) {
    std::size_t last = first;
    while (last < list.size() && list[last] != -1) ++last;
    f(first, last);
    first = last + 1;
  }
}

struct RunList {
  std::span<const std::int32_t> list;
  std::size_t n_positions;  // indices below this one are good
  std::size_t shortest;     // runs of fewer corners are dropped
};

struct RunFaults {
  std::size_t bad_indices = 0;
  std::size_t short_runs = 0;
};

/// Fills mesh.corners and mesh.face_begin. The numbers of the runs that are dropped are added to `dropped`, ascending:
/// attributes are counted in runs of the file.
RunFaults read_runs(const RunList& runs, Mesh& mesh, std::vector<std::uint32_t>& dropped);

}  // namespace wrlkit

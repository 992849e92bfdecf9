#include "geometry/geometry_lists.h"

#include <algorithm>

namespace wrlkit {
namespace {

// An index below zero is huge as an unsigned number, so that one comparison finds both kinds of invalid ones.
bool good(std::int32_t index, std::size_t n_positions) { return static_cast<std::uint32_t>(index) < n_positions; }

// Most large meshes are triangles and nothing else: four indices at a time, as long as it goes, and three at the end
// where the last -1 is missing. Returns where it stopped.
std::size_t read_triangles(const RunList& runs, std::uint32_t*& out) {
  const std::int32_t* list = runs.list.data();
  std::size_t k = 0;
  const std::size_t n = runs.list.size(), n_positions = runs.n_positions;
  for (; k + 3 <= n; k += 4) {
    std::int32_t a = list[k], b = list[k + 1], c = list[k + 2], end = k + 3 < n ? list[k + 3] : -1;
    if (!good(a, n_positions) || !good(b, n_positions) || !good(c, n_positions) || end != -1) break;
    out[0] = static_cast<std::uint32_t>(a);
    out[1] = static_cast<std::uint32_t>(b);
    out[2] = static_cast<std::uint32_t>(c);
    out += 3;
  }
  return std::min(k, n);
}

// The runs behind the leading triangles, one at a time.
class RunReader {
 public:
  RunReader(const RunList& runs, Mesh& mesh, std::vector<std::uint32_t>& dropped)
      : runs_(runs), mesh_(mesh), dropped_(dropped) {}

  RunFaults read(std::size_t from, std::uint32_t* out) {
    start_faces(out);
    for_each_run(runs_.list.subspan(from), [&](std::size_t first, std::size_t last) {
      out = add(runs_.list.subspan(from + first, last - first), out);
    });
    mesh_.corners.resize(static_cast<std::size_t>(out - mesh_.corners.data()));
    if (uniform_) mesh_.face_begin.clear();
    return faults_;
  }

 private:
  void start_faces(const std::uint32_t* out) {
    auto n_triangles = static_cast<std::uint32_t>(out - mesh_.corners.data()) / 3;
    number_ = n_triangles;
    for (std::uint32_t i = 0; i <= n_triangles; ++i) mesh_.face_begin.push_back(3 * i);
  }

  std::uint32_t* add(std::span<const std::int32_t> run, std::uint32_t* out) {
    std::size_t n_bad = 0;
    for (std::size_t i = 0; i < run.size(); ++i) {
      out[i] = static_cast<std::uint32_t>(run[i]);
      n_bad += !good(run[i], runs_.n_positions);
    }
    faults_.bad_indices += n_bad;
    faults_.short_runs += n_bad == 0 && run.size() < runs_.shortest;
    if (n_bad > 0 || run.size() < runs_.shortest) {
      dropped_.push_back(number_++);
      return out;
    }
    ++number_;
    uniform_ &= run.size() == mesh_.corners_per_face();
    out += run.size();
    mesh_.face_begin.push_back(static_cast<std::uint32_t>(out - mesh_.corners.data()));
    return out;
  }

  const RunList& runs_;
  Mesh& mesh_;
  std::vector<std::uint32_t>& dropped_;
  RunFaults faults_;
  std::uint32_t number_ = 0;
  bool uniform_ = true;  // face_begin would be redundant
};

}  // namespace

RunFaults read_runs(const RunList& runs, Mesh& mesh, std::vector<std::uint32_t>& dropped) {
  mesh.corners.resize(runs.list.size());
  std::uint32_t* out = mesh.corners.data();
  std::size_t from = mesh.kind == Mesh::Kind::faces ? read_triangles(runs, out) : 0;
  if (from < runs.list.size()) return RunReader(runs, mesh, dropped).read(from, out);
  mesh.corners.resize(static_cast<std::size_t>(out - mesh.corners.data()));
  return {};
}

}  // namespace wrlkit

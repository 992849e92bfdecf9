// What must hold of any bytes at all, read as a progressive world or mesh: an error, or meshes whose indices are good
// at any number of faces, of a size that the bytes account for. What was read whole is written, and read back as the
// same mesh.
#include <algorithm>
#include <limits>

#include "geometry/progressive/progressive_world.h"
#include "tests/fuzz/harness.h"

using namespace wrlkit;

namespace {

Mesh mesh_at(ProgressiveMesh& mesh, std::size_t n_faces) {
  mesh.coarsen_to(n_faces);
  mesh.refine_to(n_faces);
  Mesh m = mesh.mesh();
  require(m.corners.size() == 3 * mesh.n_faces(), "faces are missing");
  require(std::ranges::all_of(m.corners, [&](std::uint32_t v) { return v < m.n_positions(); }),
          "an index is out of range");
  for (const Attribute* a : {&m.normal, &m.color, &m.texcoord})
    require(std::ranges::all_of(a->index, [&](std::uint32_t i) { return i < a->count(); }),
            "an index of an attribute is out of range");
  return m;
}

void check_size(const ProgressiveRecord& r, std::size_t size) {
  require(r.vertices.size() + r.wedges.size() + r.faces.size() + r.splits.size() + r.wedge_changes.size() <= size,
          "more than there are bytes");
  require(r.values.size() <= size && r.corners.size() <= 8 * size, "more than the bytes can say");
}

void check_mesh(std::string_view bytes) {
  auto read = read_progressive(bytes);
  require(read.record.has_value() == read.error.empty(), "neither a mesh nor an error, or both");
  if (!read.record) return;
  check_size(*read.record, bytes.size());
  ProgressiveMesh mesh(*read.record);
  const std::size_t most = read.record->faces.size();
  for (std::size_t n : {most / 2, std::size_t{0}, most / 3}) mesh_at(mesh, n);
  const Mesh finest = mesh_at(mesh, std::numeric_limits<std::size_t>::max());
  if (!read.complete) return;
  auto again = read_progressive(write_progressive(*read.record).bytes);
  require(again.complete, "what was written is not read");
  ProgressiveMesh copy(std::move(*again.record));
  const Mesh other = mesh_at(copy, std::numeric_limits<std::size_t>::max());
  require(finest.corners == other.corners && std::ranges::equal(finest.positions.span(), other.positions.span()),
          "what was written is another mesh");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = text_of(data, size);
  check_mesh(bytes);
  const auto world = read_progressive_world(bytes);
  for (const auto& s : world.surfaces) check_mesh(s.stream.bytes);
  return 0;
}

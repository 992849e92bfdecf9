#include "geometry/simplify/recorder.h"

#include <numeric>

namespace wrlkit::simplify {

/// Without attributes a wedge is a vertex.
void Recorder::begin(const Surface& surface, const Wedges& wedges) {
  CollapseRecord& r = record_;
  r.width = wedges.width();
  r.values = wedges.values;
  r.wedge_vertex.resize(wedges.present() ? wedges.count() : surface.n_vertices());
  r.wedge_of_corner.assign(std::size_t{3} * surface.n_slots(), none);
  for (std::uint32_t f = 0; f < surface.n_slots(); ++f)
    for (int k = 0; surface.alive(f) && k < 3; ++k) {
      std::uint32_t w = wedges.present() ? wedges.of_face[f][k] : surface.face[f].v[k];
      r.wedge_of_corner[std::size_t{3} * f + k] = w;
      r.wedge_vertex[w] = surface.original(surface.face[f].v[k]);
    }
  row_.resize(wedges.count());
  std::iota(row_.begin(), row_.end(), 0u);
}

void Recorder::change_wedge(std::uint32_t wedge, const float* values) {
  auto row = static_cast<std::uint32_t>(record_.values.size() / record_.width);
  record_.values.insert(record_.values.end(), values, values + record_.width);
  record_.wedges.push_back({wedge, row_[wedge], row});
  row_[wedge] = row;
}

void Recorder::end_step(const EdgeCollapse& collapse, const Vec3& old_from, const Vec3& old_to, double error) {
  CollapseRecord& r = record_;
  r.steps.push_back({collapse, old_from, old_to, error, r.removed_faces.size(), r.corners.size(), r.wedges.size()});
}

}  // namespace wrlkit::simplify

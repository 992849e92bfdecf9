#include "convert/shown_surface.h"

#include <cmath>

#include "scenegraph/places/ways.h"

namespace wrlkit {
namespace {

constexpr std::size_t farthest = 1'000'000'000'000'000'000;  // distances beyond are not measured (is_usable)

}  // namespace

ShownSurface::ShownSurface(const Scene& scene, Diagnostics& diag) : diag_(diag) {
  if (!find_places(scene, places_)) give_up(most_visits, "nodes when every USE is followed");
}

void ShownSurface::add(NodeId geometry, const Mesh& mesh) {
  auto places = places_.extract(geometry.value);
  if (!mesh.is_triangles() || places.empty()) return;
  for (const Matrix& m : places.mapped()) {
    if (complete_ && corners_.size() / 3 + mesh.n_faces() > most_triangles) give_up(most_triangles, "triangles");
    if (!complete_) return;
    put(mesh, m);
  }
}

void ShownSurface::give_up(std::size_t limit, std::string_view what) {
  complete_ = false;
  diag_.report(Diag::expansion_limit, {}, limit, what);
}

void ShownSurface::put(const Mesh& mesh, const Matrix& place) {
  const bool turned = mesh.ccw == (place.determinant() < 0);
  slot_.reset(mesh.n_positions());
  bool is_far = false;
  for (auto c : mesh.corners) {
    if (!slot_.contains(c)) {
      slot_.set(c, static_cast<std::uint32_t>(positions_.size() / 3));
      const double* p = mesh.positions.data() + std::size_t{c} * 3;
      for (double v : place.point({p[0], p[1], p[2]})) {
        is_far |= !(std::abs(v) < static_cast<double>(farthest));
        positions_.push_back(v);
      }
    }
    corners_.push_back(slot_[c]);
  }
  if (is_far) return give_up(farthest, "metres from the origin");
  for (auto end = corners_.size(), i = end - mesh.corners.size(); turned && i < end; i += 3)
    std::swap(corners_[i + 1], corners_[i + 2]);
}

}  // namespace wrlkit

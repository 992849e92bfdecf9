#include "geometry/simplify/collapse.h"

#include "geometry/simplify/simplifier.h"

namespace wrlkit {

struct Collapser::Impl {
  std::unique_ptr<simplify::Simplifier> simplifier;
  Mesh flags;  // of the mesh that came in, without its arrays
};

Collapser::Collapser(const Mesh& triangles, const CollapseOptions& options)
    : impl_(new Impl{simplify::make_simplifier(triangles, options), {}}) {
  Mesh& m = impl_->flags;
  m.kind = triangles.kind;
  m.ccw = triangles.ccw;
  m.solid = triangles.solid;
  m.convex = triangles.convex;
  m.crease_angle = triangles.crease_angle;
}
Collapser::~Collapser() = default;
Collapser::Collapser(Collapser&&) noexcept = default;
Collapser& Collapser::operator=(Collapser&&) noexcept = default;

void Collapser::run_to(std::size_t n_faces, double max_error) { impl_->simplifier->run_to(n_faces, max_error); }
std::size_t Collapser::n_faces() const { return impl_->simplifier->n_faces(); }
double Collapser::error() const { return impl_->simplifier->error(); }
std::optional<EdgeCollapse> Collapser::next() { return impl_->simplifier->next(); }
std::optional<double> Collapser::cost(std::uint32_t from, std::uint32_t to) {
  return impl_->simplifier->cost(from, to);
}
const CollapseRecord& Collapser::record() const { return impl_->simplifier->record(); }

Mesh Collapser::mesh() const {
  Mesh m = impl_->flags;
  impl_->simplifier->write(m);
  return m;
}

}  // namespace wrlkit

// Writes the faces of a form into a Mesh: positions and normals in the form's own frame go through its matrix.
#pragma once
#include <initializer_list>
#include <vector>

#include "geometry/forms/form.h"

namespace wrlkit {

class FormMesh {
 public:
  FormMesh(const Matrix& frame, Mesh& mesh);

  std::uint32_t position(const Vec3& p);
  std::uint32_t normal(const Vec3& n);

  /// One after the other around a ring of positions. Without positions: a ring of no radius is one point n times.
  struct Ring {
    std::vector<std::uint32_t> positions, normals;
  };

  void corner(std::uint32_t position, std::uint32_t normal);
  void end_face();
  /// Quadrilaterals between two rings of equally many points, anticlockwise from outside when `high` lies along +Y of
  /// a ring that runs anticlockwise around Y. Where two neighbours are the same point, triangles.
  void band(const Ring& low, const Ring& high, bool closed = true);
  /// One face of a flat ring of positions.
  void cap(const std::vector<std::uint32_t>& positions, const Vec3& normal, bool reversed);
  void finish();

 private:
  const Matrix& frame_;
  Mesh& mesh_;
  std::vector<double>& positions_;
  bool triangles_ = true;
};

}  // namespace wrlkit

// Which forms (geometry/forms/form.h) a mesh is made of. By topology first: faces that lie in one plane, rings of
// quadrilaterals between two loops, caps; then by a fit, which is measured both ways.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/forms/form.h"

namespace wrlkit {

struct RecogniseOptions {
  /// Nothing is replaced by a form farther away than this, in the unit of the mesh, both ways. 0: by what a part itself
  /// shows, the distance between its chords and the circle through its points.
  double tolerance = 0;
  /// Step in which the coordinates were written, where it is known: points are that far from where they belong.
  /// 0: found from the coordinates.
  double step = 0;
};

struct RecognisedForm {
  Form form;
  std::vector<std::uint32_t> faces;  // of the mesh, rising
  /// Largest distance, both ways, between those faces and the form as it is cut with its own segments and rings.
  double residual = 0;
  bool inside_out = false;  // the faces point inwards; a form's point outwards
};

struct Recognition {
  std::vector<RecognisedForm> forms;  // in the order of their first faces
  std::vector<std::uint32_t> rest;    // faces in none of them, rising; those without an area left out
};

/// Finds forms among the faces of a mesh of polygons or triangles: loose or welded, one part or many, faces in any
/// order. Parts are separated by edges that no two faces share; a pipe run in one piece is cut at its rings. Positions
/// are compared exactly.
///
/// Linear in the corners. One thread.
Recognition recognise_forms(const Mesh& mesh, const RecogniseOptions& options = {});

}  // namespace wrlkit

// What the parts of a scene are, counted: cylinders, elbows, boxes.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "convert/document.h"
#include "geometry/mesh.h"

namespace wrlkit {

/// As the scene is shown: instances multiplied out.
struct FormsCensus {
  std::map<std::string, std::uint64_t> parts;  // by kind (kind_of)
  std::uint64_t triangles_left = 0;            // of faces that are not part of a form
  double residual = 0;                         // largest distance between a part and its form, in metres of the world
};

/// Joins and recognises (passes `join`, `recognise`) the expanded scene of a document, which is changed by it, and
/// counts; forms that the file has itself count, too. Nothing when the scene is shown more often than can be counted,
/// or is to stop. Linear in the corners.
std::optional<FormsCensus> count_forms(Document& document, const MeshSource& triangles);

}  // namespace wrlkit

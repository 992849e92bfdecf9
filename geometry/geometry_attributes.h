// Colours, normals and texture coordinates: which value each corner takes. The standard has four bindings (per vertex
// or per face, with an index list of its own or without); a Mesh has one, an index per corner.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "geometry/mesh_job.h"

namespace wrlkit {

/// Values of one attribute node and the fields that bind them.
struct AttributeBinding {
  std::string_view what;  // the field: "color", "normal", "texCoord"
  std::span<const double> values;
  std::span<const std::int32_t> index;  // colorIndex, normalIndex, texCoordIndex; empty: none
  bool per_vertex = true;
};

/// The runs of the file that the faces of the mesh come from.
struct AuthoredRuns {
  std::span<const std::int32_t> coordIndex;  // may be empty when no attribute has an index list
  std::span<const std::uint32_t> dropped;    // numbers of the runs that became no face, ascending
};

/// Binds an attribute of job.mesh, whose corners and faces are there. No values: it stays absent. Values are converted
/// to single precision; where they outnumber the corners, only those in use are copied, so that the cost stays
/// O(corners).
void bind_attribute(MeshJob& job, Attribute& attribute, const AttributeBinding& binding, const AuthoredRuns& runs);

/// How messages name a geometry: its type, and its DEF name if it has one.
std::string title(const MeshJob& job);

}  // namespace wrlkit

// A mesh as something that may stand elsewhere, too: its corners around their mean, and what of it stays the same when
// it is moved. Everything is taken over the corners of faces, so that neither the order of faces and points nor whether
// faces share points makes a difference.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/mesh.h"
#include "scenegraph/transform.h"

namespace wrlkit::instancing {

enum class Scaling : std::uint8_t { none, uniform, axis };

struct MeshForm {
  const Mesh* mesh = nullptr;
  std::vector<Vec3> at;            // of each corner, from the centre
  Vec3 centre{};                   // mean of the corners
  double size = 0;                 // root mean square of the distances from there
  double reach = 0;                // the largest of them
  std::array<double, 3> spread{};  // along the principal axes, descending

  /// The form of a mesh that outlives it. O(corners).
  void take(const Mesh& m);
  /// What has to agree exactly: kind, flags, numbers of faces by their sizes, attributes, colours.
  std::uint64_t exact_key() const;
};

/// Numbers that a motion does not change, each with its step: those of two forms that may match are less than half a
/// step apart.
std::vector<double> invariants(const MeshForm& form, Scaling scaling, double tolerance);

/// Keys under which a form is looked for: that of its own cell of invariants first, and with `all` also those of the
/// nearer neighbours in each direction, one of which a form that may match has as its own.
std::vector<std::uint64_t> cells_of(const MeshForm& form, Scaling scaling, double tolerance, bool all);

}  // namespace wrlkit::instancing

// The parts that a geometry was merged of, so that each can still be found by its name: a MetadataSet of X3D on the
// geometry. glTF has feature ids for it.
//
//   IndexedFaceSet { ... metadata MetadataSet { name "parts" value [
//     MetadataString { name "names" value [ "Unit/Pump" "Unit/Valve" ] }
//     MetadataInteger { name "faces" value [ 96 120 ] } ] } }           # the first 96 faces are the pump
#pragma once
#include <optional>

#include "scenegraph/scene.h"

namespace wrlkit {

/// One part after the other, in the order of the faces, polylines or points of the geometry.
struct Features {
  std::span<const std::string_view> names;  // paths of DEF names from the root (name_path.h)
  std::span<const std::int32_t> faces;      // how many are of each

  std::size_t n_faces() const;
};

/// None where the geometry has no parts, or describes them wrongly.
std::optional<Features> features_of(const Scene& scene, NodeId geometry);
/// The values are copied.
void set_features(Scene& scene, NodeId geometry, const Features& features);

}  // namespace wrlkit

// Meshes of many parts, taken apart: feature ids (EXT_mesh_features) of wrlkit's own files become the parts again that `merge` has
// put together, each below the groups that its name tells of.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit::gltf_reader {

/// A geometry for each part, in the order in which parts have their first face. `part_of_face` has the number of the part of
/// each face, polyline or point of an IndexedFaceSet, IndexedLineSet or PointSet. Points, colours and the like are those
/// that the part uses, in nodes of its own. Linear.
std::vector<std::pair<std::uint32_t, NodeId>> take_apart(Scene& scene, NodeId geometry, const std::vector<std::uint32_t>& part_of_face);

/// Groups by the names on the way to a part: "Unit/Pump" is a Group Pump in a Group Unit.
class PartGroups {
 public:
  /// Puts a Shape into the group of its name. The outermost one is appended to `out` when it is new.
  void put(Scene& scene, const std::string& name, NodeId shape, std::vector<NodeId>& out);
  /// Gives the groups what was put into them.
  void finish(Scene& scene) const;

 private:
  NodeId group(Scene& scene, const std::string& name, std::vector<NodeId>& out);
  std::map<std::string, NodeId, std::less<>> groups_;
  std::map<NodeId, std::vector<NodeId>> children_;
};

}  // namespace wrlkit::gltf_reader

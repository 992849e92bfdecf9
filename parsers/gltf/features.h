// Meshes of many parts, taken apart: feature ids (EXT_mesh_features) of wrlkit's own files become the parts again that
// `merge` has put together, each below the groups that its name tells of.
#pragma once
#include <map>
#include <vector>

#include "parsers/gltf/part_rows.h"
#include "scenegraph/scene.h"

namespace wrlkit::gltf_reader {

/// A geometry for each part, in the order in which parts have their first face. `part_of_face` has the number of the
/// part of each face, polyline or point of an IndexedFaceSet, IndexedLineSet or PointSet. Points, colours and the like
/// are those that the part uses, in nodes of its own. Linear.
std::vector<std::pair<std::uint32_t, NodeId>> take_apart(Scene& scene, NodeId geometry,
                                                         const std::vector<std::uint32_t>& part_of_face);

/// Groups of the rows of a table of parts.
class PartGroups {
 public:
  /// Puts a node into the group of a row; `none`: into no group. The outermost one is appended to `out` when it is new.
  void put(Scene& scene, PartRows& rows, std::uint32_t row, NodeId node, std::vector<NodeId>& out);
  /// Groups of rows that have become nothing.
  void put_empty(Scene& scene, PartRows& rows, std::vector<NodeId>& out);
  /// Gives the groups what was put into them.
  void finish(Scene& scene) const;

 private:
  NodeId group(Scene& scene, PartRows& rows, std::uint32_t row, std::vector<NodeId>& out);
  std::map<std::uint32_t, NodeId> groups_;
  std::map<NodeId, std::vector<NodeId>> children_;
};

}  // namespace wrlkit::gltf_reader

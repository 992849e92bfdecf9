// The nodes of glTF as grouping nodes, Shapes, lights and Viewpoints.
//
// A node that shows a mesh and stands where it is not moved is a Shape; others are Transforms, those that do not move
// Groups. A camera or light without children takes translation and rotation into its fields. What wrlkit's writer has
// kept in extras says which node of VRML it was instead: {} is a helper that VRML does not need, {"USE": n} is the node
// that node n of the file has become.
//
// Everything is posed as the file shows it: skins by the transforms of their joints, morph targets by their weights.
#pragma once
#include <functional>
#include <set>

#include "parsers/gltf/features.h"
#include "parsers/gltf/meshes.h"
#include "parsers/gltf/trs.h"
#include "scenegraph/builder.h"

namespace wrlkit::gltf_reader {

class Hierarchy {
 public:
  static constexpr std::size_t max_instances = 1'000'000;  // of EXT_mesh_gpu_instancing

  /// `moved`: nodes that must be Transforms.
  Hierarchy(const Context&, Extras&, Meshes&, PartRows&, const ParseLimits&, std::set<std::uint32_t> moved);

  /// All scenes; what the default one shows are the scene's roots, the others are in a Switch that shows none.
  void build();
  /// What a node has become; none when it has become nothing.
  NodeId made(std::uint32_t node) const { return node < made_.size() ? made_[node] : NodeId{}; }
  /// What was added to the translation of a node: the origin of a scene that was moved when it was written.
  Vec3 moved_back(std::uint32_t node) const {
    const auto i = moved_back_.find(node);
    return i == moved_back_.end() ? Vec3{} : i->second;
  }
  /// For each node with morph targets, the points that move.
  const std::map<std::uint32_t, std::vector<Morph>>& morphs() const { return morphs_; }
  /// What a light or camera of the file has become.
  std::vector<NodeId> lights(std::uint32_t light) const { return of(lights_, light); }
  std::vector<NodeId> cameras(std::uint32_t camera) const { return of(cameras_, camera); }

 private:
  using Nodes = std::vector<NodeId>;
  static Nodes of(const std::map<std::uint32_t, Nodes>& all, std::uint32_t i) {
    return all.contains(i) ? all.at(i) : Nodes();
  }
  enum class State : std::uint8_t { untouched, open, done };
  /// What stands for a node is appended; `origin` is to be added to the first translation.
  void visit(std::uint32_t node, std::size_t depth, const Vec3& origin, Nodes& out);
  bool is_choice(std::uint32_t node) const;
  void make(std::uint32_t node, std::size_t depth, Vec3 origin, Nodes& out);
  Nodes children(std::uint32_t node, std::size_t depth, const Vec3& origin);
  NodeId kept(std::uint32_t node, Json type_and_fields, const TransformFields&, Nodes children);
  NodeId implied(std::uint32_t node, const TransformFields&, Nodes children);
  NodeId level(Json at, const std::function<void(Nodes&)>& make_nodes);
  void add_levels(Json ids, std::size_t depth, const Vec3& origin, Nodes& out);
  void level_of_detail(std::uint32_t node, std::size_t depth, const Vec3& origin, Nodes& out);
  Nodes shapes(std::uint32_t node, const TransformFields&);
  NodeId shape(const Meshes::Part&, Json at);

  /// Of EXT_mesh_gpu_instancing.
  std::vector<TransformFields> places(Json attributes);
  void instances(Json node, Nodes& shapes);
  void own_instances(std::uint32_t node, const Vec3& origin, Nodes& out);
  NodeId transform(Json at, const TransformFields&, const Nodes& children, bool moved = false);
  static Json light_of(Json node) { return node["extensions"]["KHR_lights_punctual"]["light"]; }
  void orthographic_camera(NodeId, Json node, const TransformFields& place);
  NodeId camera(Json node, const TransformFields&);
  NodeId light(Json node, const TransformFields&, const Matrix& world);
  void light_fields(NodeId, Json light, const TransformFields&);
  Pose pose(std::uint32_t node);
  Matrix world(std::uint32_t node);
  void find_parents();
  void report(Json node);

  Context c_;
  Extras& extras_;
  Meshes& meshes_;
  PartRows& rows_;
  ParseLimits limits_;
  std::set<std::uint32_t> moved_;
  std::vector<std::uint32_t> parent_;
  std::vector<State> state_;
  std::vector<NodeId> made_;
  std::map<std::uint32_t, Vec3> moved_back_;
  std::map<std::uint32_t, std::vector<Morph>> morphs_;
  PartGroups* part_groups_ = nullptr;  // of the group whose children are made
  std::map<std::uint32_t, Nodes> lights_, cameras_;
  Nodes suns_;  // DirectionalLights: in VRML they light their group only
  std::size_t n_instances_ = 0;
  bool has_world_info_ = false, has_navigation_info_ = false;
};

}  // namespace wrlkit::gltf_reader

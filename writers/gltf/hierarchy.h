// The nodes of glTF: the transformation hierarchy unrolled, because a node of glTF has one parent. Meshes stay shared.
//
// Every grouping node is a node, with its name; so is a Shape, except that one without a name that is alone in a
// Transform or Group becomes the mesh of that node. Nodes of VRML that draw nothing (sensors, scripts, ...) are nodes
// with extras, in their place. Of a Switch the chosen child is there, the others are in extras. Of a LOD the first
// level is the child; the others hang on it by MSFT_lod, whose screen coverage is that of the level's bounding sphere
// at the distances of `range`, seen with VRML's standard field of view.
//
// A Transform whose rotation or scale is animated while it has a center or a scaleOrientation is a chain of nodes, one
// for each part of T C R SR S -SR -C that moves by itself.
#pragma once
#include <functional>
#include <map>
#include <unordered_map>

#include "writers/gltf/animations.h"
#include "writers/gltf/cameras.h"
#include "writers/gltf/gltf.h"
#include "writers/gltf/instances.h"
#include "writers/gltf/lights.h"
#include "writers/gltf/meshes.h"

namespace wrlkit::gltf {

enum class Attachment : std::uint8_t { nothing, mesh, camera, light };

struct Node {
  NodeId source{};                                // none: a helper, without a name
  std::uint32_t first_child = 0, n_children = 0;  // into Hierarchy::children
  std::uint32_t transform = none;                 // into Hierarchy::transforms
  std::uint32_t attached = none;
  Attachment attachment = Attachment::nothing;
  bool plain = true;               // the transform is what the fields of `source` say
  bool lod = false;                // has an entry in Hierarchy::lods
  std::uint32_t same_as = none;    // the node that `source` has become before
  std::uint32_t instances = none;  // into Hierarchy::instances; such a node is nobody's, its rows have sources
};

struct Lod {
  std::vector<std::uint32_t> levels;  // behind the first
  std::vector<double> coverage;       // empty: not known
};

class Hierarchy {
 public:
  Hierarchy(const Scene&, const GltfOptions&, Meshes&, Materials&, Animations&, Extras*, PartTable&, Diagnostics&);

  /// Everything below the roots of the scene.
  void build();

  /// Puts the places of instances where accessors are.
  void store_instances(Store&);
  /// Leaves out digits of transforms, as far as nothing in the world moves further than `tolerance`. How far it may
  /// move.
  double round_transforms(double tolerance);
  /// Gives nodes of meshes the transform that makes metres of whole numbers; null: a mesh needs none.
  void dequantize(const std::function<const Dequantization*(std::uint32_t mesh)>&);

  /// Every node from the roots down, behind its parent; levels of detail beside the first.
  struct Family {
    std::vector<std::uint32_t> order, parent;
  };
  Family family() const;
  /// How much lengths grow on the way to the frame that each node is in, at most.
  std::vector<double> growth(const Family&) const;

  const std::vector<Node>& nodes() const { return nodes_; }
  std::span<const std::uint32_t> children(const Node& n) const {
    return {children_.data() + n.first_child, n.n_children};
  }
  const std::vector<Trs>& transforms() const { return transforms_; }
  const std::vector<std::uint32_t>& roots() const { return roots_; }
  const std::vector<Camera>& cameras() const { return cameras_; }
  const std::vector<Light>& lights() const { return lights_; }
  const Lod& lod(std::uint32_t node) const { return lods_.at(node); }
  bool uses_lod() const { return !lods_.empty(); }
  const std::vector<Instances>& instances() const { return instances_; }
  const Box& world() const { return world_; }
  /// What a node's translation is beyond the field that it comes from.
  Vec3 offset(std::uint32_t node) const;
  /// What was subtracted from all coordinates.
  const std::optional<Vec3>& origin() const { return origin_; }
  NodeId navigation_info() const { return navigation_info_; }
  NodeId world_info() const { return world_info_; }

 private:
  enum class Kind : std::uint8_t { not_known, group, shape, light, viewpoint, other };
  struct Frame {
    NodeId node{};
    std::vector<NodeId> children{};
    std::size_t next = 0;
    std::size_t first_built = 0;  // into built_
    NodeTransform local{};
    Matrix world{};      // frame of the children
    Box box{};           // of what they show
    bool again = false;  // in something that was met before
  };
  Kind kind(NodeId);
  bool one_too_many(NodeId);
  void visit(NodeId);
  void enter(NodeId);
  void report_overflow(NodeId);
  void report_texcoords(NodeId geometry);
  void report_group(NodeId);
  void leave();
  std::uint32_t group(const Frame&);
  std::uint32_t fold(const Frame&);
  std::uint32_t fold_into(const Frame&, Node& child);
  bool says_nothing(const Node&) const;
  std::uint32_t turning(const Frame&, std::span<const std::uint32_t> children);
  bool turns_about_a_center(NodeId transform) const;
  void make_lod(const Frame&);
  std::uint32_t shape(NodeId);
  std::uint32_t light(NodeId);
  std::uint32_t viewpoint(NodeId);
  std::uint32_t other(NodeId);
  std::uint32_t add(Node, std::span<const std::uint32_t> children = {});
  /// None for the identity, unless it must be there.
  std::uint32_t add_transform(const Trs&, bool always = false);
  void add_targets(NodeId source, std::uint32_t translation, std::uint32_t rotation, std::uint32_t scale);
  void add_lost(NodeId);
  bool first_visit(NodeId, bool has_place = true);
  void set_same(std::uint32_t);
  void add_headlight();
  void move_to_origin();
  void move(std::uint32_t node, const Vec3& by, std::vector<std::uint32_t>& further);
  void report_lost();
  /// `growth`: how much lengths of the frame of the place grow in the world.
  bool only_places_a_mesh(const Node&, const Trs& place, double growth = 1) const;
  bool stays_a_node(const Node&) const;
  bool find_nodes_that_stay(const Family&, std::vector<char>& stays, std::vector<Matrix>& frame) const;
  void make_part_rows();
  void make_instances();
  /// Is another node the same once more, so that it has to stay; has it become a row of a table?
  enum class Mark : std::uint8_t { nothing, referred, row };
  std::size_t share_places(std::span<std::uint32_t> siblings, std::vector<Mark>& marks);
  void leave_out(const std::vector<Mark>& marks);

  const Scene& scene_;
  const GltfOptions& options_;
  Meshes& meshes_;
  Materials& materials_;
  Animations& animations_;
  Extras* extras_;
  PartTable& parts_;
  Diagnostics& diag_;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> children_, roots_;
  std::vector<Trs> transforms_;
  std::vector<Camera> cameras_;
  std::vector<Light> lights_;
  std::unordered_map<std::uint32_t, Lod> lods_;
  std::vector<Instances> instances_;
  Box world_;
  std::optional<Vec3> origin_;
  NodeId navigation_info_, world_info_;

  std::vector<Frame> frames_;
  std::vector<std::uint32_t> built_;  // nodes that are not yet children of their parents
  std::vector<Kind> kinds_;           // of types
  std::vector<char> visited_;
  std::unordered_map<std::uint32_t, std::uint32_t> became_;  // of nodes of VRML, the first of glTF
  std::map<std::string_view, std::size_t> lost_;             // by type: each Script has one of its own, but one name
  Span first_lost_;
  bool full_ = false;
};

}  // namespace wrlkit::gltf

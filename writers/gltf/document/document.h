// The nodes of a glTF file, as plain data. A node has one parent; what it shows is shared. build_hierarchy makes it,
// and each step that changes it is a function with a file of its own in this folder; gltf.cpp puts them in order.
#pragma once
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "writers/gltf/box.h"
#include "writers/gltf/cameras.h"
#include "writers/gltf/instances.h"
#include "writers/gltf/lights.h"
#include "writers/gltf/transform.h"

namespace wrlkit::gltf {

enum class Attachment : std::uint8_t { nothing, mesh, camera, light };

struct Node {
  NodeId source{};                                // none: a helper, without a name
  std::uint32_t first_child = 0, n_children = 0;  // into Document::children
  std::uint32_t transform = none;                 // into Document::transforms; none: the identity
  std::uint32_t attached = none;
  Attachment attachment = Attachment::nothing;
  bool plain = true;               // the transform is what the fields of `source` say
  bool moved = false;              // the origin is subtracted from its translation, which is said even where it is 0
  bool hidden = false;             // not shown, nor what is below it (KHR_node_visibility)
  bool lod = false;                // has an entry in Document::lods
  std::uint32_t same_as = none;    // the node that `source` has become before
  std::uint32_t choice = none;     // which child of a Switch that events set
  std::uint32_t instances = none;  // into Document::instances; such a node has no source, its rows have sources
};

struct Lod {
  std::vector<std::uint32_t> levels;  // behind the first
  std::vector<double> coverage;       // empty: not known
};

/// A dome around everything.
struct Sky {
  std::uint32_t node = none;
  Matrix frame{};  // that its node is in
  Vec3 centre{};   // world
  double radius = 0;
};

struct Document {
  std::vector<Node> nodes;
  std::vector<std::uint32_t> children, roots;
  std::vector<Trs> transforms;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::unordered_map<std::uint32_t, Lod> lods;  // by node
  std::vector<Instances> instances;
  Box world;
  std::optional<Sky> sky;
  std::optional<Vec3> origin;  // what was subtracted from all coordinates
  NodeId navigation_info, world_info;
  std::vector<std::pair<std::uint32_t, NodeId>> tagged_rows;  // of the table of parts: nodes that have become them

  std::span<const std::uint32_t> children_of(const Node& n) const {
    return {children.data() + n.first_child, n.n_children};
  }
  Trs place(const Node& n) const { return n.transform == none ? Trs{} : transforms[n.transform]; }

  /// Index of the new node.
  std::uint32_t add(Node, std::span<const std::uint32_t> children = {});
  /// None for the identity, unless it must be there.
  std::uint32_t add_transform(const Trs&, bool always = false);
  void set_only_child(Node& parent, std::uint32_t child);
};

/// Every node from the roots down, behind its parent; levels of detail other than the first.
struct Family {
  std::vector<std::uint32_t> order, parent;
};
Family family_of(const Document&);
/// How much lengths grow on the way to the frame that each node is in, at most.
std::vector<double> growth_of(const Document&, const Family&);
/// The same of one transform.
double stretch(const Trs&);

/// Whether another node is the same once more, so that it has to stay; whether it has become a row of a table.
enum class Mark : std::uint8_t { nothing, referred, row };
/// Removes the nodes that are rows, of marks for all; the others move up. What each index has become, none for those
/// that went.
std::vector<std::uint32_t> remove_rows(Document&, std::span<const Mark>);

}  // namespace wrlkit::gltf

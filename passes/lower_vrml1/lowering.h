// The traversal of VRML 1.0: what it knows on its way, and what it does at each kind of node. lower_vrml1.cpp has the
// nodes of VRML 1.0, other_nodes.cpp those that are not: unknown ones, and VRML97's.
#pragma once
#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "passes/lower_vrml1/frame.h"
#include "passes/lower_vrml1/lower_vrml1.h"
#include "passes/lower_vrml1/shapes.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"

namespace wrlkit::vrml1 {

/// What a node that was met before in the same state did: what it drew, and what it left.
struct Effect {
  NodeId drawn;
  State state;
  Placement at;
  std::vector<Frame::Light> lights;
};

/// Whether a world of VRML97 has nodes of VRML 1.0, or geometry without a Shape and Materials among children.
bool has_state(const Scene&);

class Lowering {
 public:
  Lowering(Scene& scene, const LowerVrml1Options& options, PassContext& ctx)
      : scene_(scene),
        diag_(ctx.diag),
        some_inherit_(any_node(scene, [&](NodeId n) { return which_child(scene, n) == inherits; })),
        looks_(scene, diag_),
        shapes_(scene, looks_, diag_, default_crease_angle()),
        steps_left_(static_cast<std::size_t>(options.limit) + steps_a_node * scene.node_count()),
        limit_(options.limit) {}

  /// A world of VRML 1.0.
  void run();
  /// A world of VRML97 that has nodes of VRML 1.0.
  void run_among_vrml97();

 private:
  static constexpr std::size_t steps_a_node = 16, deepest = 2000;
  static constexpr std::int32_t all = -3, inherits = -2, none = -1;  // of whichChild

  // Inventor 2.1 made 0 of it.
  double default_crease_angle() const { return scene_.header.starts_with("#Inventor V2.1") ? 0 : 0.5; }
  static std::int32_t which_child(const Scene& scene, NodeId n) {
    namespace v1 = nodes::vrml1;
    if (scene.is(n, v1::Switch)) return scene.get(n, v1::switch_::whichChild);
    return scene.is(n, v1::Blinker) ? scene.get(n, v1::blinker::whichChild) : none;
  }
  bool is(NodeId n, TypeId t) const { return scene_.is(n, t); }
  void legal_names();
  std::vector<std::string_view> names_in_use() const;
  void report_lost(std::span<const std::string_view> names_before);
  void report_unknown_fields();
  /// False when there is too much that comes again, which is reported once. What comes for the first time is always
  /// done.
  bool step(NodeId n);

  void visit(NodeId n, State&, Frame&);
  bool property(NodeId n, State&);
  NodeId first_equal(NodeId n);
  void visit_group(NodeId n, std::span<const NodeId> children, State&, Frame&);
  void visit_separator(NodeId n, State, Frame&);
  void visit_transform(NodeId n, State&, Frame&);
  void visit_light(NodeId n, Frame&);
  void visit_switch(NodeId n, State&, Frame&);
  std::int32_t chosen_of(NodeId n, std::size_t n_children, State&) const;
  void visit_lod(NodeId n, const State&, Frame&);
  void visit_copies(NodeId n, const State&, Frame&);
  void visit_shape(NodeId n, const State&, Frame&);

  // Nodes of others.
  NodeId known_base(NodeId unknown);
  void visit_other(NodeId n, State&, Frame&);
  void visit_unknown(NodeId n, State&, Frame&);
  void quote_words(NodeId n);
  void keep_fields(NodeId n, NodeId group);
  void visit_vrml97(NodeId n, const State&, Frame&);
  void visit_instance(NodeId n, const State&);
  NodeId vrml1_material(NodeId vrml97);
  std::vector<NodeId> vrml97_children(NodeId n, const State&);
  void lower_body(Proto&);
  void drop_routes(Scope&);

  /// `children`, which VRML97 calls `choice` and `level` in some.
  const Value* child_field(NodeId n) const {
    auto fields = scene_.type(n).fields;
    auto f = std::ranges::find(fields, "children", &FieldDef::name);
    return f == fields.end() ? nullptr : &scene_.value(n, static_cast<std::uint16_t>(f - fields.begin()));
  }
  /// As the file has them.
  std::span<const NodeId> children_of(NodeId n) const {
    if (const auto i = originals_.find(n); i != originals_.end()) return i->second;
    auto field = child_field(n);
    return field ? field->node_span() : std::span<const NodeId>{};
  }
  /// The contents of a group in a state of their own.
  Frame contents(std::span<const NodeId> nodes, State s) {
    Frame frame;
    for (NodeId c : nodes) visit(c, s, frame);
    return frame;
  }
  /// A child of Switch or LOD as a node: there must be one for each.
  NodeId choice(NodeId child, State& s, Frame& frame);
  void leave(Frame& outer, const std::vector<Frame::Light>& lights);
  void shine(Frame& frame, NodeId source, const Matrix& at);

  Scene& scene_;
  Diagnostics& diag_;
  const bool some_inherit_;  // some Switch takes its whichChild from another one
  Looks looks_;
  Shapes shapes_;
  std::map<std::pair<NodeId, State>, Effect> effects_;
  std::map<NodeId, NodeId> singles_;  // what is the same in every state
  std::map<NodeId, NodeId> bases_;
  std::unordered_map<std::string, NodeId> equals_;
  std::vector<char> met_;
  std::size_t steps_left_, depth_ = 0;
  int limit_;
  bool full_ = false;

  // Of a world of VRML97.
  std::vector<char> stateful_;                           // nodes of VRML 1.0, and what they are in; empty: all are
  std::map<NodeId, std::span<const NodeId>> originals_;  // children of groups that have others by now
};

}  // namespace wrlkit::vrml1

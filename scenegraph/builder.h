// The one door by which parsers make a scene. It knows types, scopes of names and limits; the parsers know their
// grammar. Nodes are opened and closed like the braces of the file. The fields of open nodes wait on one stack, so that
// the pools of the scene are written once, in order.
#pragma once
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

struct ParseLimits {
  std::size_t depth = 1000;  // of nested nodes
  std::size_t nodes = 200'000'000;
};

class SceneBuilder {
 public:
  SceneBuilder(Scene& scene, Diagnostics& diag) : scene_(scene), diag_(diag) { scopes_.emplace_back(); }

  Scene& scene() { return scene_; }

  // Nodes.
  NodeId open(TypeId type, std::string_view def_name, Span where);
  void close();
  std::size_t depth() const { return open_.size(); }
  /// The innermost open node.
  NodeId current() const { return open_.back().node; }
  const NodeType& current_type() const { return scene_.type(current()); }
  /// Adds a field to the innermost open node. A second value for a slot is reported; it replaces the first, but a list
  /// of nodes is joined to it.
  void field(Value v, Span where);
  /// Adds a node to a node-list field of the innermost open node (a child that stands outside of any field).
  void append_child(std::uint16_t slot, NodeId child) { open_.back().more.emplace_back(slot, child); }
  /// Fields of one interface: a slot is 16 bits.
  static constexpr std::size_t most_fields = 60'000;
  /// Declares a field of the innermost open node, a Script: it gets a type of its own. Returns the slot; none when
  /// there are too many, which is reported.
  std::optional<std::uint16_t> declare(FieldDef f, Span where);

  /// The node that USE `name` means here; none if it is not defined or would contain itself, which is reported.
  NodeId use(std::string_view name, Span where);

  // Scopes: the bodies of prototypes.
  void open_scope() { scopes_.emplace_back(); }
  /// Roots, resolved routes and prototypes of the innermost scope, which ends.
  Scope close_scope();
  void root(NodeId n) { scopes_.back().scope.roots.push_back(n); }
  void route(std::string_view from, std::string_view event_out, std::string_view to, std::string_view event_in,
             Span where);
  /// `IMPORT inline_name.exported AS name` and `EXPORT node AS name`, also of nodes that are defined later.
  void import_name(std::string_view inline_name, std::string_view exported, std::string_view name, Span where);
  void export_name(std::string_view node, std::string_view name, Span where);
  /// The interface of a prototype as a node type.
  TypeId proto_type(std::string_view name, std::span<const FieldDef> fields);
  /// Makes a prototype known under its name from here on.
  ProtoId declare_proto(Proto p, Span where);

  /// Type of a node of that name here: a prototype, a built-in type, or a new unknown type, which is reported once.
  TypeId type(std::string_view name, Span where);
  /// The type of all unknown nodes of that name, for nodes that describe themselves; nothing is reported.
  TypeId unknown_type(std::string_view name);
  /// The same without making one: TypeId{} when not known.
  TypeId known_type(std::string_view name) const;

 private:
  /// Of X3D in a file of VRML97, where programs that know both write it; TypeId{} when there is none.
  TypeId foreign_type(std::string_view name, Span where);
  struct Open {
    NodeId node;
    std::size_t first_field;
    std::vector<FieldDef> own;                           // declared by a Script
    std::vector<std::pair<std::uint16_t, NodeId>> more;  // slots and nodes that stand behind those of its fields
    std::vector<std::uint32_t> by_slot;  // one more than where the field of a slot is, once there are many
    std::size_t n_indexed = 0;           // fields that by_slot knows
  };
  struct Pending {
    std::string_view from, event_out, to, event_in;
    Span where;
  };
  struct Link {  // IMPORT, of a name that a scene exports, and EXPORT
    bool import;
    std::string_view node, exported, name;
    Span where;
  };
  struct Names {
    Scope scope;
    std::unordered_map<std::string_view, NodeId> defs;
    std::unordered_map<std::string_view, TypeId> protos;
    std::unordered_map<std::string_view, NodeId> imported;
    std::unordered_set<std::string_view> exported;
    std::vector<Pending> forward;  // ROUTEs whose nodes are defined later, as some exporters write them
    std::vector<Link> links;       // and IMPORTs and EXPORTs of such nodes
    std::size_t depth = 0;
  };
  Value* find_field(Open&, std::uint16_t slot);
  void append_all(Open&);
  void add_x3d_defaults(Open&);
  NodeId defined(std::string_view name) const;
  /// What a ROUTE means by a name.
  NodeId routed(std::string_view name) const;
  bool try_route(const Pending&);
  void link(const Link&);
  bool try_link(const Link&);
  void check_event(NodeId, std::string_view event, bool out, Span);

  Scene& scene_;
  Diagnostics& diag_;
  std::vector<Open> open_;
  std::vector<Value> fields_;
  std::vector<Names> scopes_;
  std::unordered_map<std::string_view, TypeId> unknown_;
  std::unordered_set<std::uint32_t> foreign_;  // types of X3D that were reported
};

}  // namespace wrlkit

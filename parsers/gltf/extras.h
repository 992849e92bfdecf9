// What wrlkit's glTF writer keeps below extras.vrml97, back to nodes (the form is described in writers/gltf/extras.h).
// Names are those of a scope: {"Shape": {"USE": name}} means the node that got this name last, or else one that gets it
// later. A node gets its name when it is whole, so only those can make a node contain itself: that is refused, but for
// Scripts, which may hold what they are in.
#pragma once
#include <deque>
#include <unordered_map>

#include "parsers/gltf/context.h"

namespace wrlkit::gltf_reader {

class Extras {
 public:
  explicit Extras(const Context& c) : c_(c) { scopes_.emplace_back(); }

  /// Declares the prototypes of a list.
  void protos(Json list);
  /// The type of that name here; unknown ones are made.
  TypeId type(std::string_view name, Json at);
  /// Fills a node with fields. Where a list has null or the name of the next of `children`, that child is meant, and
  /// taken away from them.
  void fields(NodeId, Json fields, std::deque<NodeId>& children);
  void fields(NodeId n, Json f) {
    std::deque<NodeId> no_children;
    fields(n, f, no_children);
  }
  /// Those alone that hold no nodes.
  void plain_fields(NodeId n, Json fields);
  /// Those alone that only say something of the node: metadata, textureProperties, and fields that its type does not
  /// have.
  void tags(NodeId n, Json fields);
  /// Makes a node known under its name.
  void define(NodeId n);
  NodeId named(std::string_view name) const;
  /// ROUTEs, IMPORTs and EXPORTs of the scene, and what Scripts hold of nodes behind them.
  void finish(Json scene);

 private:
  using Children = std::deque<NodeId>;
  struct ProtoScope {
    std::unordered_map<std::string_view, TypeId> types;
    std::size_t parent = 0;
  };
  struct Pending {
    NodeId owner;
    std::uint16_t slot;
    std::size_t position;
    std::string_view name;
  };
  using Names = std::unordered_map<std::string, NodeId>;

  void field(NodeId, Json, Children&);
  NodeId reference(Json, Children&);
  NodeId use(Json fields);
  std::optional<Value> value(FieldType, std::uint16_t slot, Json, Children&);
  std::optional<Value> numbers(FieldType, std::uint16_t slot, Json);
  Value nodes(FieldType, std::uint16_t slot, Json, Children&);
  std::optional<Value> unknown(Json, Children&);
  void bad(Json, std::string_view what);
  std::vector<FieldDef> interface(Json list, std::size_t first_slot = 0);
  void declare_fields(NodeId, Json list);
  void proto_values(NodeId, Json list);
  Scope body(Json proto);
  void resolve(std::size_t first);
  void routes(Json list, Scope&);
  void imports(Json list, Scope&);
  void exports(Json list, Scope&);
  void links(Json scope, Scope&);
  bool may_hold(NodeId owner, NodeId held);

  Context c_;
  std::vector<ProtoScope> scopes_;  // the main one first
  std::size_t scope_ = 0;
  std::unordered_map<std::string_view, TypeId> unknown_;
  Names names_;
  std::vector<Pending> pending_;
  NodeId owner_;  // whose fields are read
  std::size_t n_steps_ = 0;
};

}  // namespace wrlkit::gltf_reader

// What is known of a prototype before its first instance is expanded: where its body is (an EXTERNPROTO's is in another
// file), and which nodes of the body each instance needs for itself. Instances that would put a body into itself become
// empty Groups, which is reported.
#pragma once
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "passes/analysis/own_nodes.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct Prototype {
  enum State : std::uint8_t { fresh, busy, ready, empty, missing } state = fresh;
  ProtoId body;            // the one with a body: itself, or what an EXTERNPROTO names
  bool has_state = false;  // events can reach nodes of the body: no two instances can share them
};

class Prototypes {
 public:
  Prototypes(Scene& scene, PassContext& ctx) : scene_(scene), ctx_(ctx) {}

  /// The prototype of an instance. Its body is looked for when the first one asks.
  const Prototype& of(NodeId instance) { return prepare(scene_.type(instance).proto); }
  bool is_missing(ProtoId p) const;
  /// Nodes that each instance needs for itself, of all bodies that have been asked for.
  const OwnNodes& own() const { return own_; }
  /// A field or event of the interface of a body; null when there is none.
  const FieldDef* field(ProtoId body, std::string_view name);
  /// The exposedField that an event is one of: x, set_x, x_changed.
  const FieldDef* exposed_field(ProtoId body, std::string_view event);

 private:
  using Interface = std::unordered_map<std::string_view, const FieldDef*>;
  struct Library {
    ProtoId first;
    std::unordered_map<std::string_view, ProtoId> by_name;
    /// Null: there is none.
    ProtoId named_by(std::string_view url) const;
  };

  const Prototype& prepare(ProtoId);
  Prototype find_body(const Proto&);
  ProtoId find_external(const Proto&);
  const Library& library(const std::shared_ptr<const Scene>&);
  void look_into(const Proto&);
  void look_at(NodeId);
  std::vector<NodeId> defaults(const Proto&) const;
  std::string_view name(const Proto& p) const { return scene_.type(p.type).name; }
  std::string_view vrml97_name(std::string_view);

  Scene& scene_;
  PassContext& ctx_;
  std::unordered_map<std::uint32_t, Prototype> known_;
  std::unordered_map<std::uint32_t, Interface> interfaces_;
  std::unordered_map<const Scene*, Library> libraries_;
  std::vector<std::shared_ptr<const Scene>> kept_;
  std::vector<std::string_view> busy_;  // those that are being prepared, each needed by the one before
  std::vector<char> met_;
  OwnNodes own_;
};

}  // namespace wrlkit

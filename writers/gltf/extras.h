// What VRML has and glTF has not, kept so that it can come back: as JSON below "extras", made from the node table.
//
//   Anchor { url "pump.html" children ... }   ->   "extras": {"vrml97": {"Anchor": {"url": ["pump.html"]}}}
//
// Fields stand under their VRML97 names, away from their default only, and without those that glTF itself expresses. SF
// types of several numbers and all MF types are flat arrays. A node in a field has the same form, with "DEF" when it
// has a name; {"Shape": {"USE": name}} has a place of its own in the file, or was written before. What a Script or a
// prototype declares is listed under "interface" as [access, type, name, value], text that was kept as it is under
// "verbatim". Long fields of a node that is there several times are written only with the first. All prototypes are in
// one list; "in" is the index of the one that a prototype is declared in.
//
// Tags (scenegraph/tags.h) stand there in every file: of an Appearance with its material, of geometry and Coordinates
// with the mesh, of what has become a row of the table of parts as {row: 7, Transform: {...}} in "parts" of the scene.
// null in a field stands for the next of the node's children in glTF.
//
// {} marks a node of glTF that VRML needs not, {"USE": n} one that is the node which stands at n of the file's nodes
// once more. A type without fields, {"Group": {}}, is there where a reader would take another one: a node of glTF that
// shows a mesh and is not moved reads as a Shape, moved as a Transform with a Shape; without a mesh as a Transform, or
// if it is not moved a Group. What can be reached by a ROUTE or held by a Script gets a name of its own where it has
// none.
#pragma once
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/diagnostics.h"
#include "base/text/json.h"
#include "scenegraph/scene.h"
#include "writers/led_urls.h"

namespace wrlkit::gltf {

class Extras {
 public:
  /// Slots of a node's type whose values glTF itself has expressed.
  using Said = std::span<const std::uint16_t>;
  static constexpr std::size_t max_nodes = 5'000'000;
  /// The depth of nodes inside each other. Each is three levels of JSON; some readers refuse more than 128
  /// (serde_json).
  static constexpr std::size_t max_depth = 32;

  /// `lead`: what urls are written as; none: as they are.
  Extras(const Scene& scene, const LeadUrls& lead, Diagnostics& diag);
  /// What this Switch does not show has nodes of glTF, too.
  void set_keeps_hidden(NodeId switch_node) { marks_[switch_node.value] |= keeps_hidden_mark; }

  /// DEF name, or the one that was given to what a ROUTE or Script refers to.
  std::string_view name(NodeId n) const;
  /// Can events reach it?
  bool is_routed(NodeId n) const { return marks_[n.value] & routed; }

  /// A node that glTF has a place for: in fields of others it is only referred to.
  void set_placed(NodeId n) { marks_[n.value] |= placed; }
  bool is_placed(NodeId n) const { return marks_[n.value] & placed; }
  /// A Shape whose geometry is a mesh.
  void set_shown(NodeId n) { marks_[n.value] |= shown_mark; }

  /// Is there a field other than those?
  bool anything(NodeId n, Said said) const;
  /// Does the node hold more than its node of glTF, which reads as one of type `implied`?
  bool says_more(NodeId n, TypeId implied, bool plain_transform = true) const {
    return !scene_.is(n, implied) || anything(n, said_by_node(n, plain_transform));
  }
  /// What a node of glTF says of one of VRML. `plain_transform`: its transform is that of the fields, see
  /// NodeTransform.
  Said said_by_node(NodeId n, bool plain_transform) const;
  /// The member Type: {fields} of an object.
  void node(JsonOut&, NodeId, Said, bool with_name = false);
  /// The member vrml97: {Type: {fields}} of an object; `with_name`: its DEF name among them.
  void vrml97(JsonOut&, NodeId, Said said, bool with_name = false);
  /// The member extras: {vrml97: ...} of an object.
  void member(JsonOut&, NodeId, Said said);
  /// The member Type: {fields} of an object, with nothing but its tags (scenegraph/tags.h) and, `with_name`, its name.
  void tags(JsonOut&, NodeId, bool with_name = false);
  /// The fields of a node but for those, as members of an object.
  void other_fields(JsonOut& json, NodeId n, Said said) { fields(json, n, said, 0); }
  /// Tags as members of an object.
  void tag_fields(JsonOut&, NodeId);
  /// The member extras: {wrlkit: {Type: {fields}}} of a form with fields of our own (scenegraph/nodes/wrlkit.nodes).
  void form(JsonOut&, NodeId);
  /// The member vrml97: {Type: {fields}, polygons}: what the vertices of an IndexedFaceSet, IndexedLineSet or PointSet
  /// do not tell. A node in a field only says that it was there, and its name. `polygons` are pairs: N triangles
  /// are one polygon, M times. `step`, unless it is 1: what positions are to be multiplied by; the scale of nodes with
  /// the mesh is that and nothing else.
  void geometry(JsonOut&, NodeId, std::span<const std::uint32_t> polygons, double step);
  /// Is there anything of that?
  bool geometry_says_more(NodeId) const;
  /// The same with tags and names only: of the geometry, and of Coordinates and the like, but for names in some fields;
  /// and of all that is in a Shape that shows nothing.
  void facts_of_geometry(JsonOut&, NodeId, std::span<const std::string_view> without);
  bool has_facts_of_geometry(NodeId, std::span<const std::string_view> without) const;
  void unseen_facts(JsonOut&, NodeId shape);
  bool has_unseen_facts(NodeId shape) const;
  /// The member protos of an object: declarations, and those in their bodies behind them. Each is {PROTO: name, in,
  /// interface, body, routes} or {EXTERNPROTO: name, in, interface, url}.
  void protos(JsonOut&, std::span<const ProtoId>);
  /// "Source.event TO Target.event".
  void route(JsonOut&, const Route&) const;
  /// "inline.name AS name" and "node AS name".
  void import(JsonOut&, const Import&) const;
  void export_(JsonOut&, const Export&) const;

 private:
  enum Mark : std::uint8_t {
    placed = 1,   // it has a node of glTF
    written = 2,  // it is in a field of another
    told = 4,     // its own extras are written
    routed = 8,
    shown_mark = 16,
    keeps_hidden_mark = 32
  };
  bool shown(NodeId n) const { return marks_[n.value] & shown_mark; }
  void name_what_is_referred_to();
  Said said_by_vertices(NodeId geometry) const;
  bool adds_to_vertices(NodeId geometry, const Value&) const;
  static constexpr std::size_t depth_of_names = 3;  // of a Material in an Appearance in a Shape
  bool is_named_child(const Value&) const;
  bool adds_to_data(NodeId, const Value&) const;
  bool is_said_of(const Value&) const;
  bool is_child_with_more(const Value&) const;
  bool is_tagged_child(const Value&) const;
  bool has_facts_below(NodeId, std::size_t depth) const;
  void facts_below(JsonOut&, NodeId, std::size_t depth);
  void geometry_field(JsonOut&, NodeId, const Value&);
  bool speaks(NodeId, const Value&, Said) const;
  void fields(JsonOut&, NodeId, Said, std::size_t depth, bool only_short = false);
  void interface(JsonOut&, const NodeType&, NodeId, std::size_t depth);
  void proto(JsonOut&, const Proto&, std::optional<std::size_t> in);
  void field_value(JsonOut&, const Value&, std::size_t depth);
  /// The value of a field that no table has, with its type where JSON does not tell it: {"SFInt32": 3}.
  void unknown(JsonOut&, const Value&, std::size_t depth);
  void value(JsonOut&, const Value&, std::size_t depth);
  void reference(JsonOut&, NodeId, std::size_t depth);
  void content(JsonOut&, NodeId, std::size_t depth);
  bool too_much(NodeId, std::size_t depth);

  /// The urls of a list as they are written; false when it is not such a list.
  bool urls(JsonOut&, Span where, TypeId, std::uint16_t slot, const Value&);
  void urls(JsonOut&, Span where, std::span<const std::string_view>, UrlUse);

  const Scene& scene_;
  const LeadUrls& lead_;
  UrlFields url_fields_;
  Diagnostics& diag_;
  std::vector<std::uint8_t> marks_;
  std::unordered_map<std::uint32_t, std::string> given_;
  std::size_t n_written_ = 0;
  bool own_fields_ = false;                     // those of our own are written, too
  std::unordered_set<std::string> said_names_;  // of Coordinates and the like, alone
  std::optional<std::unordered_set<std::uint32_t>>
      body_;  // nodes of the prototype that is written: names are its own there
};

}  // namespace wrlkit::gltf

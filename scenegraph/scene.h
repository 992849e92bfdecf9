// What a scene is: nodes in one pool, named by NodeId; each node stores its type, its DEF name, where it was read, and
// only the fields that were written. Defaults live in the node table. DEF/USE makes it a directed graph: a node may be
// held by several fields, and parents are computed when asked for (walk.h). Ids and arrays stay when nodes are added;
// what points into the fields of a node (fields, find, value) holds until the next field is set, of whatever node.
//
// Copying a scene copies the pools but shares the arrays (arena.h), which are immutable. What is added to either of the
// two later is its own, so that they may be worked on in two threads.
#pragma once
#include <algorithm>
#include <cassert>
#include <deque>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/arena.h"
#include "base/source.h"
#include "scenegraph/node_table.h"

namespace wrlkit {

struct Route {
  NodeId from, to;
  std::string_view event_out, event_in;
  bool operator==(const Route&) const = default;
};

/// IMPORT of X3D (ISO/IEC 19775-1, 4.4.6): ROUTEs here may lead to a node that an inlined scene exports.
struct Import {
  NodeId inline_node;
  std::string_view exported;  // the name in that world
  NodeId node;  // stands for the one that is meant, in ROUTEs and exports alone; has the name of this scope
};

/// EXPORT of X3D: what the scenes that inline this one may import.
struct Export {
  NodeId node;
  std::string_view name;
};

/// A name scope of the standard (ISO/IEC 14772-1, 4.4.7): the file, or the body of a PROTO.
struct Scope {
  std::vector<NodeId> roots;
  std::vector<Route> routes;
  std::vector<ProtoId> protos;  // declared here, in order
  std::vector<Import> imports{};
  std::vector<Export> exports{};
};

struct Proto {
  TypeId type;  // the interface, as a node type of this scene
  bool external = false;
  std::vector<std::string_view> urls;  // of an EXTERNPROTO
  Scope body;                          // of a PROTO
  std::uint32_t roots_before = 0;      // root nodes of its scope that stand before it; a name may be declared again
  Span where;
};

/// What an X3D file says of itself in front of its nodes (ISO/IEC 19775-1, 7.2.5). Units have been applied.
struct X3dHead {
  int version = 33;  // 33: 3.3
  std::string profile;
  std::vector<std::pair<std::string, int>> components;    // name, level
  std::vector<std::pair<std::string, std::string>> meta;  // name, content
};

enum class Format : std::uint8_t { none, vrml1, vrml97, x3d_classic, x3d_xml, gltf };

/// Whether a C++ value can be given to fields of a type. Numbers become those of the field: 1 is 1.0 for an SFFloat. A
/// list may be given as its only element.
template <FieldType T, class V>
constexpr bool fits_field() {
  constexpr auto& field = info(T);
  constexpr bool is_single = !field.multiple && field.arity == 1;
  if constexpr (field.element == Element::text)
    return std::is_convertible_v<V, std::string_view> ||
           (field.multiple && std::is_convertible_v<V, std::span<const std::string_view>>);
  else if constexpr (field.element == Element::node)
    return std::is_same_v<V, NodeId> || (field.multiple && std::is_convertible_v<V, std::span<const NodeId>>);
  else if constexpr (field.element == Element::image)
    return std::is_convertible_v<V, std::span<const std::int32_t>>;
  else if constexpr (field.element == Element::integer)
    return std::is_integral_v<V> || (field.multiple && std::is_convertible_v<V, std::span<const std::int32_t>>);
  else if constexpr (std::is_arithmetic_v<V>)
    return field.arity == 1 && !std::is_same_v<V, bool>;
  else if constexpr (requires { std::tuple_size<V>::value; })  // as many numbers as an element has, or whole elements
    return std::is_convertible_v<V, std::span<const double>> && !is_single &&
           (field.multiple ? std::tuple_size<V>::value % field.arity == 0 : std::tuple_size<V>::value == field.arity);
  else
    return !is_single && std::is_convertible_v<V, std::span<const double>>;
}

/// The arrays that a scene makes, and those that it shares. A copy makes its own from then on.
class Arenas {
 public:
  Arenas() = default;
  Arenas(const Arenas& other) : shared_(other.shared_) { share(other.own_); }
  Arenas(Arenas&&) noexcept = default;
  Arenas& operator=(Arenas other) noexcept {
    std::swap(own_, other.own_);
    std::swap(shared_, other.shared_);
    return *this;
  }
  ~Arenas() = default;

  Arena& own() const { return *own_; }
  void share_all(const Arenas& other) {
    share(other.own_);
    for (const auto& arena : other.shared_) share(arena);
  }

 private:
  void share(const std::shared_ptr<Arena>& arena) {
    if (arena && std::ranges::find(shared_, arena) == shared_.end()) shared_.push_back(arena);
  }

  std::shared_ptr<Arena> own_ = std::make_shared<Arena>();
  std::vector<std::shared_ptr<Arena>> shared_;  // of what this is a copy of, and of imported scenes
};

class Scene {
 public:
  Scene();

  // What the file says apart from nodes.
  Format format = Format::vrml97;
  std::string header;   // of VRML 1.0 and Inventor: the first line, for Inventor's version is in it
  std::string comment;  // the comment lines that follow the header, with their '#'
  X3dHead x3d;
  Scope main;
  std::shared_ptr<Sources> sources;
  Span file;  // where it begins: messages about all of it are there

  // Nodes.
  NodeId add(TypeId, Span where = {});
  /// The node of an Import: of a type that nothing else has, without fields.
  NodeId add_stand_in(std::string_view name, Span where = {});
  std::size_t node_count() const { return nodes_.size(); }
  TypeId type_id(NodeId n) const { return nodes_[n.value].type; }
  const NodeType& type(NodeId n) const { return type(nodes_[n.value].type); }
  const NodeType& type(TypeId t) const;
  bool is(NodeId n, TypeId t) const { return n && type_id(n) == t; }
  /// True for any of these abstract types; never an instance of a prototype, a Script or a node that is not known.
  bool is(NodeId n, BaseSet any) const { return n && type(n).is_a(any); }
  /// DEF name, or empty. Names need not be unique: USE means the last one before it (4.4.3), here it is an id.
  std::string_view name(NodeId n) const { return names_[nodes_[n.value].name]; }
  void set_name(NodeId, std::string_view);
  Span where(NodeId n) const { return {nodes_[n.value].offset, 1}; }
  /// Relative urls of a node are relative to the file that its place lies in.
  void set_where(NodeId n, Span where) { nodes_[n.value].offset = where.begin; }
  /// What a glTF file says becomes VRML97.
  Dialect dialect() const {
    if (format == Format::vrml1) return Dialect::vrml1;
    return format == Format::vrml97 || format == Format::gltf ? Dialect::vrml97 : Dialect::x3d;
  }

  /// Fields that were written, in the order they were written; of nodes with very many of them in the order of their
  /// slots. Valid until a field of any node is set: loops that write take `copy_of_fields`.
  std::span<const Value> fields(NodeId n) const {
    return {fields_.data() + nodes_[n.value].first_field, nodes_[n.value].n_fields};
  }
  std::vector<Value> copy_of_fields(NodeId n) const {
    const auto now = fields(n);
    return {now.begin(), now.end()};
  }
  /// The written value of a slot, or null. Valid as long as `fields`.
  const Value* find(NodeId, std::uint16_t slot) const;
  /// The value of a slot: written or default. Never null for fields that have values.
  const Value& value(NodeId, std::uint16_t slot) const;
  /// Name of the field a Value of this node belongs to, and the Value itself, for known and unknown fields alike.
  std::string_view field_name(NodeId, const Value&) const;
  const Value& content(const Value& v) const { return v.slot == Value::extra_slot && v.extra ? v.extra->value : v; }
  bool is_extra(const Value& v) const { return v.slot == Value::extra_slot; }

  /// Typed access by the generated constants. Numbers of SF types with more than one come as Vec2/3/4, MF types as
  /// spans over the flat array. An IS or a value of another type reads as the default.
  template <FieldType T>
  auto get(NodeId n, FieldKey<T> key) const;
  /// Writes a field; arrays are copied into the arena.
  void set(NodeId n, Value v);
  /// Writes fields: keys and values in turn. A value that does not fit its field does not compile.
  template <FieldType T, class V, class... More>
  void set(NodeId n, FieldKey<T> key, const V& v, const More&... more) {
    static_assert(fits_field<T, std::decay_t<V>>(), "a value of another type than the field");
    assert(type(n).fields[key.slot].name == type(key.node).fields[key.slot].name && "a key of another node type");
    if constexpr (std::is_floating_point_v<V>)
      set(n, make(T, key.slot, static_cast<double>(v)));
    else if constexpr (std::is_integral_v<V> && !std::is_same_v<V, bool>)
      set(n, make_whole(T, key.slot, static_cast<std::int64_t>(v)));
    else
      set(n, make(T, key.slot, v));
    if constexpr (sizeof...(more) > 0) set(n, more...);
  }
  void unset(NodeId n, std::uint16_t slot);
  /// All fields at once, replacing those that were there; what the builder and the passes that rewrite nodes use.
  void set_fields(NodeId n, std::span<const Value> fields);
  /// Turns a node into another one in place: type and fields change, its id, name and place stay. References hold.
  void become(NodeId n, TypeId type, std::span<const Value> fields);

  // Values with their arrays in this scene's arena: of that type, whatever they are made of. Numbers that a value has
  // too few of are 0, and a list that is given one element has that one.
  Value make(FieldType, std::uint16_t slot, std::span<const double>);
  Value make(FieldType, std::uint16_t slot, std::span<const std::int32_t>);
  Value make(FieldType, std::uint16_t slot, std::span<const std::string_view>);
  Value make(FieldType, std::uint16_t slot, std::span<const NodeId>);
  template <class T>
  Value make(FieldType t, std::uint16_t slot, const std::vector<T>& v) {
    return make(t, slot, std::span<const T>(v));
  }
  template <std::size_t N>
  Value make(FieldType t, std::uint16_t slot, const std::array<double, N>& v) {
    return make(t, slot, std::span<const double>(v));
  }
  Value make(FieldType, std::uint16_t slot, std::string_view);
  Value make(FieldType t, std::uint16_t slot, const char* v) { return make(t, slot, std::string_view(v)); }
  Value make(FieldType t, std::uint16_t slot, const std::string& v) { return make(t, slot, std::string_view(v)); }
  Value make(FieldType, std::uint16_t slot, double);
  Value make(FieldType, std::uint16_t slot, bool);
  Value make(FieldType, std::uint16_t slot, std::int32_t);
  Value make(FieldType, std::uint16_t slot, NodeId);
  /// A field that the node type does not have.
  Value make_extra(std::string_view name, Value);
  std::string_view keep(std::string_view s) { return arena().copy(s); }
  Arena& arena() { return arenas_.own(); }

  // Types and prototypes of this scene.
  /// Adds a type; names and arrays in it must live in the arena or in the table.
  TypeId add_type(NodeType, std::span<const FieldDef> fields);
  /// Those that were added, in order; TypeId = builtin_nodes().size() + index.
  const std::deque<NodeType>& own_types() const { return types_; }
  ProtoId add_proto(Proto);
  void set_type_proto(TypeId t, ProtoId p) { types_[t.value - builtin_nodes().size()].proto = p; }
  std::size_t proto_count() const { return protos_.size(); }
  Proto& proto(ProtoId p) { return protos_[p.value]; }
  const Proto& proto(ProtoId p) const { return protos_[p.value]; }

  /// Takes over all nodes, types and prototypes of another scene; its arrays are shared, not copied. Returns the scope
  /// that was `other.main`, in this scene's ids. Its texts become sources of this scene, so that messages and relative
  /// urls of the nodes mean the files that they were read from; whether these may be read is for the document
  /// (Document::import). Names are not changed, nor is `main`. O(nodes of other).
  Scope import(const Scene& other);

 private:
  Value make_whole(FieldType, std::uint16_t slot, std::int64_t);

  struct Node {
    TypeId type;
    std::uint32_t name = 0;  // into names_; 0: none
    std::uint32_t offset = Span::nowhere;
    std::uint32_t first_field = 0;
    std::uint32_t n_fields = 0;
  };

  std::vector<Node> nodes_;
  std::vector<Value> fields_;
  std::vector<std::string_view> names_{std::string_view{}};
  std::deque<NodeType> types_;  // of this scene; TypeId = builtin_nodes().size() + index
  std::deque<Proto> protos_;
  TypeId stand_in_;  // once there is one
  Arenas arenas_;
};

template <FieldType T>
auto Scene::get(NodeId n, FieldKey<T> key) const {
  const Value* v = &value(n, key.slot);
  assert(type(n).fields[key.slot].name == type(key.node).fields[key.slot].name && "a key of another node type");
  if (v->is || v->type != T) v = &type(key.node).fields[key.slot].default_value;
  if constexpr (T == FieldType::SFBool)
    return v->integer != 0;
  else if constexpr (T == FieldType::SFInt32)
    return v->integer;
  else if constexpr (T == FieldType::SFFloat || T == FieldType::SFTime || T == FieldType::SFDouble)
    return v->number;
  else if constexpr (T == FieldType::SFVec2f || T == FieldType::SFVec2d)
    return Vec2{v->numbers[0], v->numbers[1]};
  else if constexpr (T == FieldType::SFVec3f || T == FieldType::SFVec3d || T == FieldType::SFColor)
    return Vec3{v->numbers[0], v->numbers[1], v->numbers[2]};
  else if constexpr (T == FieldType::SFRotation || T == FieldType::SFColorRGBA || T == FieldType::SFVec4f)
    return Vec4{v->numbers[0], v->numbers[1], v->numbers[2], v->numbers[3]};
  else if constexpr (T == FieldType::SFString || T == FieldType::SFEnum || T == FieldType::SFBitMask)
    return v->text();
  else if constexpr (T == FieldType::MFString)
    return v->text_span();
  else if constexpr (T == FieldType::SFNode)
    return v->node;
  else if constexpr (T == FieldType::MFNode)
    return v->node_span();
  else if constexpr (T == FieldType::MFInt32 || T == FieldType::SFImage || T == FieldType::MFBool)
    return v->integer_span();
  else
    return v->number_span();
}

}  // namespace wrlkit

// The table of node types: what the parser accepts, what the writers print, what `verify` checks and what `explain`
// says all derive from it. The built-in rows are generated from scenegraph/nodes/*.nodes by tools/gen_nodes; a
// scene adds rows of the same shape for its PROTOs, Scripts and unknown nodes.
#pragma once
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "scenegraph/value.h"

namespace wrlkit {

/// field, exposedField, eventIn, eventOut of VRML97; initializeOnly, inputOutput, inputOnly, outputOnly of X3D.
enum class Access : std::uint8_t { init, inout, in, out };

/// Dialects, as bits, so that one row can be valid in several. `wrlkit`: fields and nodes that no standard has, in
/// which passes and writers tell each other of baked light and of recognised forms. They are read in every dialect;
/// fields are written on request only, nodes as the faces they represent.
enum class Dialect : std::uint8_t { vrml1 = 1, vrml97 = 2, x3d = 4, wrlkit = 8 };
using DialectSet = std::uint8_t;

struct FieldRange {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool contains(double v) const { return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high); }
  bool bounded() const {
    return low != -std::numeric_limits<double>::infinity() || high != std::numeric_limits<double>::infinity();
  }
};

struct NodeType;

struct FieldDef {
  std::string_view name;         // of X3D, which is VRML97's unless `vrml97_name` says otherwise
  std::string_view vrml97_name;  // "choice" for Switch.children; empty: the same
  FieldType type;
  Access access;
  DialectSet dialects;
  Value default_value;  // of `type`; out and in fields have none
  FieldRange range;
  std::span<const std::string_view> kinds;  // node types or bases a node field may hold; keywords an SFString may be
  std::string_view unit;                    // "length", "angle", ...; empty: none
  std::string_view doc;
  std::string_view default_text;  // as the table has it, for documentation
  std::uint8_t since = 0;         // version of X3D that it came with, 40 for 4.0; 0: one that is not newer than 3.3
  std::uint8_t x3d_from = 0;  // version of X3D, 33 for 3.3, from which the default is x3d_default; 0: it never differs
  Value x3d_default;

  bool is_own() const { return dialects == static_cast<DialectSet>(Dialect::wrlkit); }
  bool has_value() const { return access == Access::init || access == Access::inout; }
  /// The default by a version of X3D. Scenes are made so that a field that is not written has `default_value`.
  const Value& x3d_default_in(int version) const {
    return x3d_from && version >= x3d_from ? x3d_default : default_value;
  }
  /// For a field of nodes: whether it may hold one of that type.
  bool accepts(const NodeType&) const;
  std::string_view name_in(Dialect d) const {
    return d == Dialect::vrml97 && !vrml97_name.empty() ? vrml97_name : name;
  }
};

/// Abstract types of the standards, as bits: `nodes::X3DGeometryNode | nodes::X3DTextureNode` is either. The constants
/// are generated.
struct BaseSet {
  std::uint64_t bits = 0;

  friend constexpr BaseSet operator|(BaseSet a, BaseSet b) { return {a.bits | b.bits}; }
};

/// What a node type is, where the passes must tell apart; everything else is in `bases`.
enum class NodeKind : std::uint8_t { builtin, proto, script, unknown };

struct NodeType {
  std::string_view name;
  NodeKind kind = NodeKind::builtin;
  DialectSet dialects = 0;
  std::span<const FieldDef> fields;
  std::span<const std::string_view> bases;  // every direct and indirect base: "X3DGroupingNode", "X3DChildNode", ...
  BaseSet base_set;                         // the same; empty except for built-in types
  std::string_view clauses;                 // "vrml97 6.11; x3d 13.3.2"
  std::string_view component;               // X3D component and level: "Geometry3D 1"
  std::string_view container_field;         // X3D XML
  std::string_view doc;
  ProtoId proto;                           // of kind proto
  std::span<const std::uint16_t> by_name;  // slots in the order of their names, of a type of a scene with many fields

  std::uint8_t since = 0;  // as of a field

  static constexpr std::size_t many_fields = 32;

  bool is_own() const { return dialects == static_cast<DialectSet>(Dialect::wrlkit); }
  /// A file may give it fields that its type does not list: a node that is not known, or a program of a surface.
  bool takes_any_field() const;
  bool is_a(BaseSet any) const { return base_set.bits & any.bits; }
  /// True for that name, or a base of that name: for names that are not known when compiling.
  bool is_named(std::string_view name_or_base) const;
  /// Index of the field of that name in that dialect, in O(log of many fields). Accepts `set_x` and `x_changed` for an
  /// inout field `x`, as ROUTE and IS do, when `events` is set.
  std::optional<std::uint16_t> find(std::string_view field, Dialect, bool events = false) const;
};

/// The built-in rows. TypeId t with t.value < size() is row t.
std::span<const NodeType> builtin_nodes();
/// Row of that name in that dialect; TypeId{} when there is none. O(1).
TypeId find_builtin(std::string_view name, Dialect);
/// Names of the abstract bases, for checks of the table.
std::span<const std::string_view> builtin_bases();

/// A field of a node type known when compiling: `scene.get(n, nodes::cone::height)`. The constants are generated.
template <FieldType T>
struct FieldKey {
  TypeId node;
  std::uint16_t slot;
};

}  // namespace wrlkit

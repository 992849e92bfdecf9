// Recursive descent over the grammar of annex A; functions carry the names of its productions where they have one. A
// function that meets a fault reports it once and returns; the caller that owns the brace skips to it. Statements,
// nodes and their fields are in parser.cpp, prototypes, Scripts and ROUTEs in declarations.cpp, what is of VRML 1.0 in
// vrml1_among_vrml97.cpp.
#pragma once
#include <algorithm>
#include <deque>
#include <optional>
#include <unordered_set>

#include "parsers/vrml/deferred_lists.h"
#include "parsers/vrml/node_pattern.h"
#include "parsers/vrml/parser.h"
#include "parsers/vrml/values.h"
#include "parsers/x3d/units.h"
#include "scenegraph/access_word.h"
#include "scenegraph/builder.h"
#include "scenegraph/nodes.h"

namespace wrlkit::vrml {

class Parser : private Values {
 public:
  /// Lists of numbers are left to `lists`, if there are any.
  Parser(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag,
         DeferredLists* lists = nullptr)
      : Values(text, base, scene, diag), limits_(limits), build_(scene, diag), lists_(lists) {}

  /// False when a list that was left to others is written in a way that only the parser itself can read.
  bool vrml_scene();
  void set_part_read(const PartRead* part_read) { part_read_ = part_read; }

 private:
  // Statements.
  /// Up to the end of the text, or of the body of a PROTO, which ends with a brace.
  void statements(Kind until);
  /// PROTO, EXTERNPROTO, ROUTE, IMPORT and EXPORT, which may stand between nodes and between fields. False: it is none.
  bool statement(Token);
  /// PROFILE, COMPONENT, META and UNIT of X3D.
  void head_statement(Token keyword);
  std::string_view word_or_string();
  /// Something that fits nowhere: skipped with everything it brackets, one message for a run of them.
  void stray();
  bool is_stray(Token t) const { return t.kind == Kind::open_bracket || value_like(t) || text(t) == "IS"; }

  // Nodes.
  bool node_follows(Token name) const;
  bool node_list_follows();
  /// nodeStatement, or NULL. None when there is no node; then only a faulty token was consumed.
  NodeId node_statement();
  /// The same where only children stand.
  NodeId child_statement();
  NodeId node(Token type_name, std::string_view def);
  TypeId node_type(Token name, bool among_children);
  bool reads_as_vrml1(const NodeType& old, const NodeType* now);
  bool in_vrml1() const { return build_.depth() > 0 && build_.current_type().is_a(nodes::Vrml1Node); }
  void node_body(Token opened);
  void tell_part_read();
  /// A node statement among others, which may be written like the one before it.
  NodeId next_node(bool children, NodePattern& before);
  NodeId node_again(NodePattern&);
  void forget_lists();
  bool read_again(const NodePattern&);
  bool is_for_others(std::string_view list) const { return lists_ && list.size() >= RepeatedLists::shortest; }
  NodePattern& begin_pattern();
  void node_body_element(Token);
  void implicit_child(Token);
  /// Gives the nodes that were met in places for no node since `mark`: mostly the closing brace of the one before them
  /// is missing, so that they belong into the list that it is in.
  template <class F>
  void take_misplaced(std::size_t mark, F&& take) {
    std::for_each(misplaced_.begin() + static_cast<std::ptrdiff_t>(mark), misplaced_.end(), take);
    misplaced_.resize(mark);
  }

  // Fields.
  void known_field(std::uint16_t slot, const FieldDef&, Token name);
  /// A list of numbers for other threads. False: it is none for them, and nothing was read.
  bool deferred_list(FieldType, std::uint16_t slot, Token name);
  void unknown_field(Token name);
  /// `IS name` behind a field name. True when it was one.
  bool is_clause(FieldType, std::uint16_t slot);
  Value is_value(Token is, FieldType, std::uint16_t slot);
  /// A value of any type. False: there was none, which was reported; what stood in its place is skipped.
  bool value(FieldType, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out);
  bool single_node(std::uint16_t slot, std::string_view field, Value& out);
  bool node_list(std::uint16_t slot, Value& out);
  void list_elements(Token opened, bool children);
  bool property_node(std::uint16_t slot, NodeId& out);
  bool holds_children(std::uint16_t slot) const;
  NodeId shape_around(NodeId);

  // Declarations.
  void proto(Token keyword);
  void externproto(Token keyword);
  struct Interface {
    std::vector<FieldDef> fields;
    std::unordered_set<std::string_view> names;
  };
  Interface interface(bool with_values);
  /// interfaceDeclaration behind its access word. The default value goes into the FieldDef.
  bool declaration(Access, bool with_value, FieldDef&, Token& name);
  bool declaration_follows(Token access);
  void script_declaration(Access, Token keyword);
  void undeclarable(Access, Token keyword);
  void route_statement(Token keyword);
  bool route_end(std::string_view& node, std::string_view& event);
  void import_export(Token keyword);

  ParseLimits limits_;
  SceneBuilder build_;
  DeferredLists* lists_;
  const PartRead* part_read_ = nullptr;  // null: not needed
  std::uint32_t told_ = 0;               // offset up to which it was reported
  std::vector<NodeId> nodes_, misplaced_;
  std::deque<NodePattern> patterns_;          // of the last node of each open list
  std::vector<NodePattern::List> lists_met_;  // by nodes that are still open, or by their neighbours
  std::vector<NodePattern::List> lists_again_;
  std::vector<Value> values_again_;
  std::size_t n_statements_ = 0;              // that are no nodes
  std::vector<const Interface*> interfaces_;  // of the prototypes whose bodies are being read
  std::size_t scope_depth_ = 0, open_lists_ = 0;
  bool among_children_ = false;  // of the node that follows
  x3d::Units units_;
};

}  // namespace wrlkit::vrml

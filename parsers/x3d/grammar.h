// Recursive descent over the elements. Each function reads one kind of element; what a child is for, its containerField
// says, and where that is wrong or missing, the node table. Nodes are read in parser.cpp, prototypes, Scripts and
// ROUTEs in declarations.cpp.
#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>

#include "parsers/x3d/units.h"
#include "parsers/x3d/values.h"
#include "scenegraph/builder.h"

namespace wrlkit::x3d {

using Names = std::unordered_set<std::string_view>;

/// The value of a field whose type is not known, as VRML would write it: what is not a number is a string.
std::string as_vrml(std::string_view);

class Parser : private AttributeValues {
 public:
  Parser(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag)
      : AttributeValues(text, base, scene, diag),
        limits_(limits),
        build_(scene, diag),
        whole_(text),
        tree_(read_xml(text)) {}

  void document();

 private:
  /// What is known of an open node in addition to its type: the fields that a Script declares, and nodes in fields
  /// without a slot.
  struct Element {
    std::string_view name;
    std::map<std::string_view, FieldDef> own;
    std::map<std::string_view, std::vector<NodeId>> extra;
    std::string program;  // of a Script, as far as it is read
    Span program_at;
  };

  // The document.
  void head(const XmlNode&);
  void component(const XmlNode&);
  void unit(const XmlNode&);
  void comment(const XmlNode&);
  void roots(const XmlNode&);
  /// ProtoDeclare, ROUTE and the like, which may stand between nodes anywhere. False: it is none.
  bool statement(const XmlNode&);

  // Nodes.
  NodeId node(const XmlNode&);
  TypeId type_of(const XmlNode&);
  void attributes(const XmlNode&, Element&);
  void attribute(const XmlAttribute&, Element&);
  void child(const XmlNode&, Element&);
  void child_node(const XmlNode&, Element&);
  void put(const XmlNode&, NodeId, Element&);
  bool put_into_slot(std::uint16_t slot, NodeId, Span);
  std::optional<std::uint16_t> slot_by_kind(NodeId) const;
  void program(const Element&);
  void extras(Element&);

  // Declarations.
  void is_element(const XmlNode&, Element&);
  void connect(const XmlNode&, Element&);
  void script_field(const XmlNode&, Element&);
  void field_value(const XmlNode&);
  std::optional<FieldDef> declaration(const XmlNode&, bool with_value);
  /// The value of a field or fieldValue element: its attribute, or the nodes in it.
  bool element_value(const XmlNode&, FieldType, std::uint16_t slot, std::string_view name, const Value& fallback,
                     Value& out);
  std::vector<FieldDef> interface(const XmlNode&, Names&);
  void proto(const XmlNode&);
  void externproto(const XmlNode&);
  void route(const XmlNode&);
  void import(const XmlNode&);
  void export_(const XmlNode&);

  // The tree.
  template <class F>
  void for_each_child(const XmlNode& n, F f) {
    for (auto i = n.first_child; i != XmlNode::none; i = tree_.nodes[i].next) f(tree_.nodes[i]);
  }
  template <class F>
  void for_each_element(const XmlNode& n, F f) {
    for_each_child(n, [&](const XmlNode& c) {
      if (c.kind == XmlNode::Kind::element) f(c);
    });
  }
  const XmlNode* find_element(const XmlNode&, std::string_view name);
  std::optional<std::string_view> raw(const XmlNode&, std::string_view name) const;
  std::string_view get(const XmlNode& n, std::string_view name) {
    auto v = raw(n, name);
    return v ? plain(*v) : std::string_view{};
  }
  /// The name of a node. XML can hold some that no other encoding can write: blanks and the like become '_',
  /// with a number behind where another node has that name.
  std::string_view name_of(std::string_view attribute);
  std::string free_name(std::string_view name);
  Span where(const XmlNode& n) const { return span_of(n.name); }
  Span where(const XmlNode& n, std::string_view attribute) const {
    auto v = raw(n, attribute);
    return v ? span_of(*v) : where(n);
  }
  void unknown(const XmlNode& n) { diag_.report(Diag::unknown_element, where(n), n.name); }

  ParseLimits limits_;
  SceneBuilder build_;
  std::string_view whole_;
  XmlTree tree_;
  Units units_;
  std::vector<const Names*> interfaces_;  // of the prototypes whose bodies are being read
  std::set<std::string> taken_;           // names of the file; empty until one is needed
  std::map<std::string, std::string_view, std::less<>> repaired_;
  std::size_t depth_ = 0;
};

}  // namespace wrlkit::x3d

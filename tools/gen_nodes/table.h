// The node table as scenegraph/nodes/*.nodes say it; the notation is in scenegraph/nodes/README.md.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scenegraph/value.h"

namespace gen_nodes {

struct Field {
  std::string access, type, name, vrml97, unit, doc, default_text, low = "-inf", high = "inf";
  bool low_open = false, high_open = false, ranged = false;
  std::vector<std::string> kinds;
  std::vector<std::string> values;      // of the default: numbers, strings without quotes
  std::vector<std::string> x3d_values;  // of X3D's default, where it has another one
  int x3d_from = 30;                    // in version 3.0, or from this one on
  std::string only;
  int since = 0;  // version of X3D; 0: one that is not newer than 3.3
};

struct Node {
  std::string name, clauses, component, container, maker, doc;
  std::vector<std::string> bases;
  std::vector<Field> fields;
  bool abstract = false;
  int since = 0;  // as of a field
};

/// Bits of wrlkit::Dialect.
int dialects(const std::string& clauses);
wrlkit::FieldType type_of(const std::string& name);
/// Prints file:line: text, and exits with 1.
[[noreturn]] void fail(const std::string& why);

class NodeTable {
 public:
  void read(const char* path);
  /// That the fields of nodes hold types that there are.
  void check_kinds() const;

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::map<std::string, Node>& bases() const { return bases_; }
  /// Direct and indirect, depth first.
  std::vector<std::string> all_bases(const Node&) const;
  /// containerField of X3D: the node's own, or that of the first base that has one.
  std::string container(const Node&) const;

 private:
  Node* begin_node(Node);
  void add_field(Node*, const std::string& text, const std::string& doc);
  void add_bases(const Node&, std::vector<std::string>& out) const;

  std::vector<Node> nodes_;
  std::map<std::string, Node> bases_;
  std::set<std::string> seen_;
};

}  // namespace gen_nodes

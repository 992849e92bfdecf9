// Worlds made of the table of node types: fields with values of their types, nodes where a field accepts them,
// prototypes, ROUTEs between events of one type. The mutator of the fuzzers (world_mutator.h) puts them into worlds.
#pragma once
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/node_table.h"

namespace wrlkit {

enum class Encoding : std::uint8_t { vrml, xml };

/// A node with a DEF name, which USE and ROUTE may name.
struct NamedNode {
  std::string name;
  const NodeType* type;
};

/// A field: in XML what has no nodes is an attribute.
struct FieldText {
  std::string attribute, content;
};

class WorldText {
 public:
  /// `named`: nodes that stand before what is made.
  WorldText(Dialect dialect, Encoding encoding, std::mt19937& random, std::vector<NamedNode> named = {});

  /// A whole file.
  std::string file();
  /// A node that may stand at the top.
  std::string root();
  /// A field of a node that it may have; empty when it has none.
  FieldText field(const NodeType&);
  /// The declaration of a prototype and an instance of it.
  std::string proto();
  /// Between two of the named nodes; empty when none fit.
  std::string route();
  std::string number(const FieldRange& = {});

 private:
  using Types = std::vector<const NodeType*>;
  template <class List>
  const auto& one_of(const List& list) {
    return list[random_() % std::size(list)];
  }
  bool one_in(unsigned n) { return random_() % n == 0; }
  bool has(DialectSet dialects) const { return dialects & static_cast<DialectSet>(dialect_); }
  std::vector<const FieldDef*> fields_of(const NodeType&) const;
  FieldText field(const FieldDef&, int depth);
  std::string node(const NodeType*, std::string_view container, int depth);
  std::string node_for(const FieldDef&, int depth);
  std::string value(const FieldDef&);
  std::string text(const FieldDef&);
  std::string words(const FieldDef&);
  std::string image();
  std::string instance(const std::string& name, const FieldDef* given);

  Dialect dialect_;
  Encoding encoding_;
  std::mt19937& random_;
  std::vector<NamedNode> named_;
  std::size_t n_names_;
  Types types_, roots_;  // of the dialect; those that may stand at the top
};

}  // namespace wrlkit

// A node that is written like the one before it, letter for letter but for its lists of numbers: exporters that give
// each face a Shape of its own write a plant in this way. Its text is compared instead of read; what it became is made
// once more, with other numbers.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit::vrml {

class NodePattern {
 public:
  /// A list of numbers: what stands between its brackets, and the field that it is in.
  struct List {
    std::string_view text;
    NodeId node;
    std::uint16_t slot;
    FieldType type;
  };
  static constexpr std::size_t most_nodes = 16, most_lists = 8, longest = 1024;  // bytes without those of the lists

  void forget() { nodes_.clear(); }
  bool empty() const { return nodes_.empty(); }
  std::size_t n_nodes() const { return nodes_.size(); }

  /// Remembers a node, which is `first` and all that came after it, and its text with these lists, in order. Forgets
  /// what was there; does nothing more when the node has names, types of the file, or fields that are not known.
  void learn(const Scene&, std::string_view text, std::uint32_t base, NodeId first, std::span<const List> lists);

  /// The length of such a node that a text begins with; 0: it begins otherwise. `lists` are those of this node, their
  /// nodes counted from the first.
  std::uint32_t match(std::string_view text, std::vector<List>& lists) const;
  /// The value of a list that is written as that of the node that was learnt was; null: it is another one.
  const Value* known(std::size_t list, std::string_view text) const {
    const KnownList& known = lists_[list];
    return known.is_short && known.text == text ? &known.value : nullptr;
  }
  /// Makes a node like it: `lists` as they were found in its text, which begins at `where`, and their values.
  void make(Scene&, std::uint32_t where, std::string_view text, std::span<const List> lists,
            std::span<const Value> values);

 private:
  static constexpr std::uint32_t no_list = 0xffffffff;
  struct Node {
    TypeId type;
    std::uint32_t piece, offset;  // where it is, in the text between two lists
    std::uint32_t first_field, n_fields;
  };
  struct Field {
    Value value;
    std::uint32_t list;  // no_list: the value itself
  };
  struct KnownList {
    std::uint32_t node;  // from the first
    std::uint16_t slot;
    FieldType type;
    bool is_short;
    std::string text;  // of a short one
    Value value;
  };
  bool learn_nodes(const Scene&, std::uint32_t base, std::string_view text, std::span<const List> lists);
  Value moved(Scene&, Value, std::uint32_t by) const;

  NodeId first_;
  std::vector<Node> nodes_;
  std::vector<Field> fields_;
  std::vector<KnownList> lists_;
  std::string pieces_;  // the text without the lists
  std::vector<std::uint32_t> piece_ends_;
  std::vector<Value> values_;
};

}  // namespace wrlkit::vrml

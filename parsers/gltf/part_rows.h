// The table that feature ids of wrlkit's own files lead to: names of parts and groups (writers/gltf/parts.h). A
// property table of EXT_structural_metadata with the columns "name" and "parent", or a list of paths in the extras of
// the asset.
#pragma once
#include <string>
#include <vector>

#include "parsers/gltf/context.h"

namespace wrlkit::gltf_reader {

struct PartRow {
  std::string name;
  std::uint32_t parent = none;  // always a row before this one
};

class PartRows {
 public:
  /// Reads the table when it is first asked for.
  explicit PartRows(const Context& c) : c_(c) {}

  const std::vector<PartRow>& rows();
  /// Is more than one item in the row: parts, places, other rows? A place that is alone has the name itself.
  bool is_group(std::uint32_t row);
  /// A row has become a node, or a group of nodes.
  void set_made(std::uint32_t row, NodeId node) { made_[row] = node; }
  /// None: nothing yet.
  NodeId made(std::uint32_t row) const { return made_[row]; }
  /// Ids of an accessor of feature ids; empty, and a message, if they are none. `none` for what has no part.
  std::vector<std::uint32_t> ids(Json set, Json attributes);
  std::vector<std::uint32_t> ids(Json set, const std::vector<double>& values);

 private:
  void read_table(Json table);
  void read_paths(Json list);
  std::optional<std::vector<std::uint64_t>> column(Json view, std::string_view type, std::size_t n);
  void count();

  Context c_;
  bool read_ = false, counted_ = false;
  std::vector<PartRow> rows_;
  std::vector<std::uint8_t> times_;  // up to 2
  std::vector<NodeId> made_;
};

}  // namespace wrlkit::gltf_reader

// Names of parts, as the rows of a table that feature ids lead to: those of merged meshes (EXT_mesh_features), and with
// --names table also those of places (EXT_instance_features). A row is a part or a group; it has a name, and the row of
// the group that it is in.
//
//   0: Plant, in nothing   1: Unit_1, in 0   2: Pump, in 1
//
// --names table writes them as a property table (EXT_structural_metadata) with the columns "name" and "parent", and
// where parts are of several files (tiles) "source": which of them, as an enumeration. Otherwise they are a list in the
// extras of the asset, of the names on the way to each part: "Plant/Unit_1/Pump".
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "writers/gltf/store.h"

namespace wrlkit::gltf {

/// A column of the table. Stride 0: bytes that are not to be packed.
struct Column {
  std::string bytes;
  std::uint8_t stride = 0;
};

class PartTable {
 public:
  struct Row {
    std::string name;
    std::uint32_t parent = none;
    bool claimed = false;         // a node has become it
    std::uint32_t source = none;  // of sources()
  };

  /// `columns`: names are written without the groups above them. `sources`: files that parts are from, sorted.
  explicit PartTable(bool columns, std::vector<std::string> sources = {})
      : columns_(columns), sources_(std::move(sources)) {}

  /// The row of a part of a merged mesh, by the names from the root with '/' between them; the same for the same names.
  std::uint32_t of_path(std::string_view path);
  /// The row of a node: the first of a name in a group is the row that of_path knows, every other one has its own.
  std::uint32_t add(std::string_view name, std::uint32_t parent);
  /// The same of a node whose name is, where there are sources, all names on the way to its part.
  std::uint32_t of_node(std::string_view name, std::uint32_t parent) {
    return sources_.empty() ? add(name, parent) : of_path(name);
  }

  bool columns() const { return columns_; }
  const std::vector<Row>& rows() const { return rows_; }
  /// The columns, in 16 or 32 bits as they need; when they are to be packed in 32. All texts; where each begins, and
  /// where the last ends; parents, and what stands for none.
  Column texts() const;
  Column offsets(bool packed) const;
  Column parents(bool packed) const;
  /// Of each row the number of its source, or no_source.
  Column row_sources() const;
  const std::vector<std::string>& sources() const { return sources_; }
  bool any_without_source() const;
  static constexpr std::uint32_t no_source = 65535;
  /// Whether there is a column of parents: always where there are sources, so that all tiles of a set have the same
  /// ones.
  bool has_parents() const;
  static std::uint32_t no_parent(bool packed, std::size_t n_rows) { return packed || n_rows > 65535 ? none : 65535; }

 private:
  std::uint32_t find_or_add(std::string_view name, std::uint32_t parent);
  bool columns_;
  std::vector<std::string> sources_;
  std::vector<Row> rows_;
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t, std::less<>> known_;
};

}  // namespace wrlkit::gltf

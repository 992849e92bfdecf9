// The pieces of all files of a set, on disk until tiles are made of them.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "convert/tiles.h"
#include "convert/tiles/looks.h"
#include "convert/tiles/piece_store.h"
#include "convert/tiles/scene_pieces.h"
#include "parsers/resources.h"

namespace wrlkit::tiles {

class InputPieces {
 public:
  /// `most`: triangles of a piece. `passes`: that files go through first, as -p has them. Files are read through
  /// `reader`, whose messages are then those of all of them; a full disk is reported as that of `set`.
  InputPieces(Document& reader, std::size_t most, const std::string& passes, const std::string& set)
      : reader_(reader), most_(most), passes_(passes), set_(set) {}

  /// Makes the file on disk, in a folder. False, which is reported, when it cannot be made.
  bool open(const std::string& folder);
  /// Reads the files one after the other; one that cannot be read, or does not fit into the memory, costs itself, and
  /// one that another of them inlines is shown there alone. Counts files, triangles and parts in `made`. False, which
  /// is reported, when there are no pieces or the disk is full.
  bool read(std::span<const TilesInput> inputs, TilesMade& made);

  /// In the order of the files.
  const std::vector<PieceStore::Entry>& entries() const { return entries_; }
  Piece piece(std::uint32_t entry) const { return store_->read(entries_[entry]); }
  const Looks& looks() const { return looks_; }
  /// The pictures of the looks, and no other files.
  FileResources& pictures() const { return *pictures_; }

 private:
  /// What came of a file.
  struct Taken {
    std::vector<PieceStore::Entry> entries;
    SceneCounts counts;
    std::size_t triangles = 0, parts = 0;
    bool is_read = false, is_inlined = false;
  };
  bool take(const TilesInput& input, Taken& out);
  bool read_scene(const std::string& path);

  Document& reader_;
  std::size_t most_;
  const std::string &passes_, &set_;
  Looks looks_;
  std::optional<PieceStore> store_;
  std::vector<PieceStore::Entry> entries_;
  bool is_full_ = false;  // the disk
  std::unique_ptr<FileResources> pictures_;
};

}  // namespace wrlkit::tiles

// Pieces on disk: what keeps a plant of any size out of memory. The file has no name and is gone with the program.
#pragma once
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/io/content_hash.h"
#include "convert/tiles/piece.h"
#include "geometry/space_cells.h"

namespace wrlkit::tiles {

class PieceStore {
 public:
  /// Where a piece is, and what is known of it without reading it. 96 bytes.
  struct Entry : SpaceItem {
    std::uint64_t offset = 0;
    std::uint64_t name = 0;  // hash_of_name
    ContentHash hash = {};   // of all but its look
  };

  /// In a folder that must be there. Nothing, and why, when no file can be made in it.
  static std::optional<PieceStore> open(const std::string& folder, std::string& why);

  /// False when the disk is full, once and for all. Any thread.
  bool add(const Piece& piece, Entry& entry);
  /// Any thread; a piece without a mesh when the disk fails.
  Piece read(const Entry& entry) const;
  std::uint64_t bytes() const { return state_->end; }

 private:
  struct State {
    int fd = -1;
    std::uint64_t end = 0;
    bool failed = false;
    std::mutex mutex;
    ~State();
  };
  std::unique_ptr<State> state_;
};

/// Tells names from one another.
std::uint64_t hash_of_name(std::string_view name);

/// Writes pieces into a file of their own, whole or not at all. Its size, or nothing when it cannot be written.
std::optional<std::uint64_t> write_pieces(const std::string& path, std::span<const Piece> pieces);
/// What write_pieces has written; fewer when the disk fails.
std::vector<Piece> read_pieces(const std::string& path);
/// The hashes of their names alone, without reading their meshes.
std::vector<std::uint64_t> read_names(const std::string& path);

}  // namespace wrlkit::tiles

// Pieces on disk: what keeps a plant of any size out of memory. The file has no name and is gone with the program.
#pragma once
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "convert/tiles/piece.h"

namespace wrlkit::tiles {

class PieceStore {
 public:
  /// Where a piece is, and what is known of it without reading it. 40 bytes.
  struct Entry {
    std::uint64_t offset;
    std::uint32_t bytes, n_drawn;
    Vec3 centre;
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

}  // namespace wrlkit::tiles

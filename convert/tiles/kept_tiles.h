// The tiles that have been made, by what they were made of (cell_keys.h), in a folder of their own next to the tileset:
// what a run that was killed goes on from, what several processes share, and what an update need not make again.
#pragma once
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostics.h"
#include "base/io/content_hash.h"
#include "base/io/line_journal.h"
#include "base/math/box.h"

namespace wrlkit::tiles {

struct Said {
  Diag id;
  std::vector<std::string> args;
};
/// What was said without a place; and says it to somebody else.
std::vector<Said> said_in(const Diagnostics&);
void say(const std::vector<Said>&, Diagnostics& to);

/// A tile that was written, and what is known of it.
struct MadeTile {
  Box box = {};                                 // of what it shows itself
  double rounding = 0;                          // metres
  std::uint64_t hash = 0;                       // of its bytes
  std::size_t triangles = 0, draws = 0;         //
  std::size_t parts = 0;                        // different names
  std::uint64_t bytes = 0;                      // 0: it shows nothing, and there is no file
  std::optional<std::uint64_t> pieces_bytes{};  // of a coarse one, whose pieces are kept for the tiles above
  std::vector<Said> said = {};
};

class KeptTiles {
 public:
  struct Shard {
    std::uint32_t index = 0, count = 1;
  };

  /// In `folder`. False, reported, when it cannot be written, or when other processes work there that are no shards of
  /// the same run.
  bool open(const std::string& folder, Shard shard, Diagnostics& diag);
  /// A folder in which nothing was kept is removed.
  ~KeptTiles();

  /// Null when it was not made, or is not there any more.
  const MadeTile* find(const ContentHash& key) const;
  std::optional<double> error(const ContentHash& key) const;
  /// Where the tile and its pieces are, or have to be before save().
  std::string tile_path(const ContentHash& key) const;
  std::string pieces_path(const ContentHash& key) const;
  /// One thread at a time; false when it could not be written.
  bool save(const ContentHash& key, const MadeTile& tile);
  bool save_error(const ContentHash& key, double metres);

  /// Ends the part of a shard. True for one of those that no other works next to: it knows what all others have made.
  bool become_last();
  void forget();  // all of it, from the disk, too
  /// All but what is named so.
  void forget_others(const std::vector<ContentHash>& keys);

 private:
  void read();
  void read_line(const std::string& text);
  bool is_there(const ContentHash& key, const MadeTile& tile) const;

  std::string folder_;
  int lock_ = -1;
  std::optional<LineJournal> journal_;
  std::unordered_map<std::string, MadeTile> tiles_;  // by the key as text
  std::unordered_map<std::string, double> errors_;
};

}  // namespace wrlkit::tiles

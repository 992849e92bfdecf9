// The folder that a set of tiles is made in, until it takes the place of the set that was there.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "base/diagnostics.h"

namespace wrlkit::tiles {

/// How names of folders begin that a run leaves only when it is killed; the next one removes them.
inline constexpr std::string_view unfinished_folder = ".unfinished-";

class Staging {
 public:
  /// Makes a folder in `folder`, which is made as well where it is not there, and removes those that runs have left
  /// that were killed. False, reported, when that fails.
  bool open(const std::string& folder, Diagnostics& diag);
  /// What was not published is gone.
  ~Staging();

  std::string path() const { return at_.string(); }
  /// Gives the folder its name and writes tileset.json next to it, which refers to it; then removes the folders of
  /// other sets. False, reported, when that fails; the set that was there stays.
  bool publish(const std::string& name, const std::string& tileset, Diagnostics& diag);

 private:
  std::error_code make_own();
  void remove_left_behind() const;

  std::filesystem::path folder_, at_;
  bool made_ = false;  // folder_
  int lock_ = -1;      // as long as somebody has it, nobody removes the folder
};

/// Name of a folder of tiles by a hash of what is in them.
std::string tiles_folder(std::uint64_t hash);

}  // namespace wrlkit::tiles

// Files that passes have made (Resources::made), next to the world that refers to them: room.wrl has room.baked_0.png.
#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/io/output.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// "out/room" of out/room.wrl and of out/room.wrl.gz.
std::filesystem::path stem_of(const std::string& output);

class MadeFiles {
 public:
  /// Made files of the scene that is written to `output`; "-": there are no files next to it. They begin with the name
  /// of the output, or lie in a folder that is named after it (`own_folder`).
  MadeFiles(const Scene& scene, const Resources& resources, std::string output, bool own_folder, Diagnostics& diag);

  /// The url under which the scene that is written finds a file that was made; it will be written. Other urls stay as
  /// they are. A name that the scene has for another file gets a number.
  std::string place(std::string_view url);
  /// Writes those that were placed, and those that are always wanted, into temporary files. False, and a message, when
  /// one cannot be written.
  bool write();
  /// Puts them into their places; best before the world itself. A file with other contents that is replaced is
  /// reported.
  bool commit();

 private:
  struct Placed {
    std::string name;
    const MadeFile* file;
    std::optional<OutputFile> output;
  };
  const std::string& name_of(const MadeFile& file);

  const Resources& resources_;
  std::string output_, beginning_;
  Diagnostics& diag_;
  std::set<std::string, std::less<>> taken_;  // urls of the world
  std::vector<Placed> placed_;
};

}  // namespace wrlkit

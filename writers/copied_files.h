// Files that a scene refers to and that could not be read from where it is written: they come along into a folder next
// to it. out/room.wrl has out/room_files/brick.png.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/resources.h"
#include "scenegraph/urls.h"

namespace wrlkit {

/// What is copied in addition to sounds, programs and other scenes.
struct CopiedKinds {
  bool textures = true;  // of ImageTexture
  bool pictures = true;  // others
};

/// Whether a file, by its canonical path, stands to the output as it does to the input.
using MirroredFiles = std::function<bool(const std::string& path)>;

/// A scene that comes along brings the files that it refers to, and they stand to it as before. Only files that may be
/// read are copied, each once; of files with equal contents that only the written scene refers to, one is copied. What
/// an Anchor leads to stays where it is.
class CopiedFiles {
 public:
  /// Looks for the files of the scene that is written to `output`; nothing is written yet. The folder is named after
  /// the output unless a name is given. What `is_mirrored`, if that is given, counts as next to the output. Where
  /// textures are copied, a list of urls that leads only to where nothing may be read is reported. O(nodes), and parses
  /// scenes that come along.
  CopiedFiles(const Scene& scene, Resources& resources, const std::string& output, std::string folder,
              CopiedKinds kinds, MirroredFiles is_mirrored, Diagnostics& diag);
  /// Copies of a scene that was not written are removed.
  ~CopiedFiles();
  CopiedFiles(const CopiedFiles&) = delete;

  /// Nothing when the file is not copied.
  std::optional<std::string> url(std::string_view url, Span where, UrlUse use) const;
  /// Writes the copies. False, and a message, when one cannot be written.
  bool write();
  /// The world is written.
  void keep() { written_.clear(); }

 private:
  bool is_copied(UrlUse use) const;
  bool is_here(const std::string& path) const;
  void find_files(std::span<const std::string_view> urls, Span where, UrlUse use);
  void add_of_world(const std::string& path);
  void add_of_gltf(const std::string& path, const Scene& scene);
  void place_all();
  const std::string* equal_file(const std::string& path);
  bool write(const std::string& from, const std::filesystem::path& to);

  const Scene& scene_;
  Resources& resources_;
  std::string folder_;
  CopiedKinds kinds_;
  Diagnostics& diag_;
  std::filesystem::path here_;  // canonical: the folder of the output
  MirroredFiles is_mirrored_;
  std::set<std::string> fixed_;                          // files that scenes which come along are or refer to
  std::map<std::string, std::filesystem::path> places_;  // of the copy of each file, below here_
  std::map<std::uintmax_t, std::vector<std::string>> by_size_;
  std::vector<std::filesystem::path> written_;
};

}  // namespace wrlkit

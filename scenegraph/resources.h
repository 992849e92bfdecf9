// What a scene refers to: pictures, other scenes, bytes. The interface through which passes and writers reach them; the
// implementation (parsers/resources.h) reads files below the allowed folders and nothing else.
#pragma once
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/image/image.h"
#include "base/io/files_read.h"
#include "base/io/files_written.h"
#include "scenegraph/builder.h"
#include "scenegraph/scene.h"

namespace wrlkit {

struct PatchSet;  // scenegraph/patches.h

/// A file as it is: what glTF embeds without touching it.
struct Blob {
  std::string name;  // file name without folder
  std::string bytes;
  std::string_view mime;  // "image/png", "image/jpeg", ... by magic bytes; empty: unknown
};

/// Urls of files that exist in memory only, until a writer gives them a place.
inline constexpr std::string_view made_scheme = "wrlkit:";

struct MadeFile {
  std::string name;  // "lightmap_0.png"
  std::shared_ptr<const std::string> bytes;
  bool always = false;  // written even if the scene that is written does not refer to it
};

/// A file that an option of a pass names: a list or a table, for people.
struct NamedFile {
  std::string path, bytes;
};

/// The name, next to the file that is written, of the file that has such a url.
using PlaceMade = std::function<std::string(std::string_view url)>;

/// A scene, and which of the urls led to it: what follows '#' there names a part of it.
struct LinkedWorld {
  std::shared_ptr<const Scene> scene;  // null: none could be read
  std::string_view url;
};

/// What a url leads to. content: it holds the data, or a pass has made the file.
struct UrlTarget {
  enum class Kind : std::uint8_t { nothing, content, file, outside };  // outside: of the folders that may be read
  Kind kind = Kind::nothing;
  std::string path = {};  // of a file: absolute, without links
};

class Resources {
 public:
  virtual ~Resources() = default;

  /// Without opening or reporting anything.
  virtual UrlTarget target(std::string_view, Span, const Sources&) { return {}; }
  /// A scene, to see what it refers to, at a path that target() gave; null when there is nothing to
  /// be had. Nothing is reported, nothing kept.
  virtual std::shared_ptr<const Scene> look_into(const std::string&) { return nullptr; }

  /// The scene that a text of a Script is; `name` is for messages. Null, reported, when it is none.
  virtual std::unique_ptr<Scene> parse(std::string_view, const std::string&, const ParseLimits&, Diagnostics&) {
    return nullptr;
  }

  /// The first of the urls that can be read, for a node that was read at `where` (relative urls are relative to that
  /// file). Reports and returns null when none can. Each file is read once; later calls return the same object.
  virtual std::shared_ptr<const Blob> bytes(std::span<const std::string_view> urls, Span where, Diagnostics&) = 0;
  virtual std::shared_ptr<const Image> image(std::span<const std::string_view> urls, Span where, Diagnostics&) = 0;
  virtual LinkedWorld world(std::span<const std::string_view> urls, Span where, Diagnostics&) = 0;

  /// A patch file that the user names, relative to where he is; null, reported, when nothing of it can be read.
  virtual std::shared_ptr<const PatchSet> patches(const std::string&, Diagnostics&) { return nullptr; }

  /// Hands in a file that a pass has made and returns its url, made_scheme + name: whoever asks for that gets these
  /// bytes. A name that is taken gets a number. Writers put what is made inside their file, or next to it. Not while
  /// others ask.
  std::string add_made(MadeFile);
  /// In the order in which they were handed in.
  const std::deque<MadeFile>& made() const { return made_; }
  /// Drops all but the first `n` of them: the others are of a copy of the scene that is gone. Not while others ask.
  void keep_made(std::size_t n);
  /// Null when there is none of that url.
  const MadeFile* find_made(std::string_view url) const;

  /// Hands in a file that the user wants at `path`: it is written together with the other outputs, whole or not at all
  /// (writers/named_files.h). The last one for a path counts.
  void add_named(NamedFile);
  /// Those that were handed in since the last call.
  std::vector<NamedFile> take_named() { return std::exchange(named_, {}); }

  /// The folders that may be read.
  virtual std::vector<std::string> folders() const { return {}; }
  /// Files below these may be read from now on. Not while others ask.
  virtual void allow(const std::vector<std::string>&) {}

  /// What was read from until now; outputs do not replace it.
  FilesRead& files_read() { return files_read_; }
  const FilesRead& files_read() const { return files_read_; }
  /// What is written next to them.
  FilesWritten& files_written() const { return files_written_; }

 protected:
  /// What is known of the file that was made by that url.
  virtual void forget(const std::string&) {}

 private:
  std::deque<MadeFile> made_;
  std::vector<NamedFile> named_;
  FilesRead files_read_;
  mutable FilesWritten files_written_;
};

}  // namespace wrlkit

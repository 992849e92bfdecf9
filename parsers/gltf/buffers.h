// The bytes behind bufferViews: of the binary chunk, of data URIs, of files below the allowed folders; unpacked where
// EXT_meshopt_compression says so. Each buffer is read once, when it is first asked for.
#pragma once
#include <optional>

#include "base/io/allowed_files.h"
#include "parsers/gltf/file.h"

namespace wrlkit::gltf_reader {

struct ViewBytes {
  std::string_view bytes;
  std::size_t stride = 0;  // 0: packed
};

class Buffers {
 public:
  static constexpr std::uint64_t max_bytes = std::uint64_t{4} << 30;  // of all buffers and unpacked views

  /// `path` is the file's own; empty: it lies in no folder, and its files are looked for in those that are allowed.
  Buffers(File& file, std::string path, const std::vector<std::string>& allowed, std::vector<FileLookup>* lookups);

  /// Nothing when it cannot be read, which was reported.
  std::optional<ViewBytes> view(std::uint32_t index);
  /// The bytes that a bufferView-like object names by buffer, byteOffset and byteLength.
  std::optional<std::string_view> slice(Json of);
  /// What the uri of a buffer or image leads to.
  std::optional<std::string> load(Json owner, std::string_view uri);
  /// Reports files of buffers that are not there, also where extras say all that was to be read: others need them.
  void look_for_unread();

 private:
  struct Buffer {
    bool tried = false;
    std::string own;
    std::optional<std::string_view> bytes;
  };
  struct View {
    bool tried = false;
    std::string unpacked;
    std::optional<ViewBytes> bytes;
  };
  std::optional<std::string_view> buffer(std::uint32_t index);
  /// The file, or nothing, which was reported.
  std::optional<std::string> find(Json buffer, std::string_view uri);
  std::optional<ViewBytes> make_view(Json, View&);
  bool unpack(Json compression, View&);
  bool spend(std::uint64_t bytes, Json on);

  File& file_;
  std::string path_;
  std::vector<std::string> allowed_;
  AllowedFiles files_;
  std::vector<FileLookup>* lookups_;
  std::vector<Buffer> buffers_;
  std::vector<View> views_;
  std::uint64_t spent_ = 0;
};

}  // namespace wrlkit::gltf_reader

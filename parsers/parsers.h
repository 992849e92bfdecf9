// From a file to a scene: reading, telling the format by its header, dispatch.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/io/allowed_files.h"
#include "base/io/read_file.h"
#include "scenegraph/builder.h"
#include "scenegraph/scene.h"

namespace wrlkit {

struct ReadOptions {
  ReadLimits limits;
  ParseLimits parse;
  std::vector<std::string> allowed = {};       // folders other than the file's own that its buffers may lie in (glTF)
  std::vector<FileLookup>* lookups = nullptr;  // gets each buffer that is looked for
};

/// What a text is by its first bytes; the file's name does not matter. none: not a format that is read.
Format sniff_format(std::string_view text);
std::string_view to_string(Format);

struct World {
  Scene scene;
  Format format = Format::none;
  bool gzip = false;
  std::uint64_t bytes = 0;  // on disk
};

/// Reads a scene. Null when no scene can be read; why is in `diag`. The text is not kept.
std::unique_ptr<World> read_world(const std::string& path, const ReadOptions&, Diagnostics& diag);
/// The same from a file that was read already.
std::unique_ptr<World> parse_world(const FileText& file, const ReadOptions&, Diagnostics& diag);
/// The same from memory; `name` is for messages.
std::unique_ptr<World> parse_world(std::string_view text, std::string name, const ReadOptions&, Diagnostics& diag);

}  // namespace wrlkit

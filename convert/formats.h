// Every file format in one table. `wrlkit formats`, the choice of the writer, help texts, the corpus verbs and the
// pages of the documentation read it. A new output format is a row here, and a writer (writing.h).
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "convert/options.h"
#include "parsers/parsers.h"

namespace wrlkit {

struct Writing;

struct FileFormat {
  std::string_view name;     // "VRML97"
  std::string_view endings;  // ".wrl .wrz .wrl.gz", the usual one first; of pictures, their kinds
  std::string_view first_bytes;
  std::string_view reads, writes;  // for people; writes: "no", or what options are about it
  Format parsed = Format::none;    // what sniff_format says of it; none: it is not a scene by itself

  // Of formats that `convert` writes:
  /// Writes a scene that has gone through the pipeline, whole or not at all; false, reported, when it could not be.
  bool (*write)(const Writing&) = nullptr;
  /// The pipeline that a scene goes through before.
  std::string (*pipeline)(const SaveOptions&) = nullptr;
  bool meshes = false;   // the writer asks for meshes one by one
  bool is_text = false;  // refers to files next to it as VRML does
};

std::span<const FileFormat> formats();

/// The endings of a row, one by one.
std::vector<std::string_view> endings_of(const FileFormat&);
/// Endings of files that hold scenes, the longest first: ".wrl.gz" before ".wrl".
const std::vector<std::string_view>& scene_endings();
/// Endings of the files that `convert` writes.
std::vector<std::string_view> output_endings();
/// ".glb, .gltf, .wrl or .x3d": the usual ending of each format that is written, for messages.
std::string output_endings_text();
/// The ending in the list that a file name has, whatever its case; empty when it has none of them.
std::string_view ending_of(std::string_view name, std::span<const std::string_view> endings);
/// What a file of another program is, by the ending of its name: "Wavefront OBJ" of .obj; empty: not known, or ours.
std::string_view foreign_format(std::string_view name);
/// Whether a file with that ending is packed.
bool is_packed_ending(std::string_view ending);

/// Where something is to be written.
struct Output {
  const FileFormat* format = nullptr;
  std::string path;  // "-" is standard output
  bool gzip = false;
};
/// By the ending of the name, whatever its case; "-" is a .glb. Nothing when no format that is written has it.
std::optional<Output> output_of(const std::string& path, const SaveOptions& = {});

}  // namespace wrlkit

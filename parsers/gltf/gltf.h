// glTF 2.0 and GLB to a scene in the vocabulary of VRML97. What becomes of each element is written in the headers of
// this folder: file and json (taking it apart), buffers, accessors, meshopt, draco (numbers), hierarchy, meshes,
// materials, extras (what wrlkit's own writer has kept). What VRML cannot express is reported by name, as lost;
// extensions that are not known and extras are kept as text in a WorldInfo.
//
// Untrusted input: each index, offset, count and stride is checked; what a few bytes can claim is limited.
#pragma once
#include <string>
#include <vector>

#include "base/io/allowed_files.h"
#include "scenegraph/builder.h"

namespace wrlkit::gltf_reader {

/// Fills a scene of format vrml97. `base`: offset of the bytes in the sources; `path`: of the file, for what lies
/// next to it; `allowed`: further folders that buffers may lie in; `lookups`, if any, gets each that is looked for
/// there.
void parse(std::string_view bytes, std::uint32_t base, const std::string& path, const std::vector<std::string>& allowed,
           std::vector<FileLookup>* lookups, const ParseLimits&, Scene&, Diagnostics&);

/// A GLB, or JSON that has an "asset".
bool looks_like_gltf(std::string_view bytes);

}  // namespace wrlkit::gltf_reader

// Patch files (scenegraph/patches.h), as tolerant as the parser of scenes: a fault costs the patch it is in.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "base/io/read_file.h"
#include "scenegraph/patches.h"

namespace wrlkit {

/// Is that text a patch file, by its first element?
bool is_patch_file(std::string_view text);

/// Reads a patch file, also a gzipped one. Null when nothing can be read; why is in `diag`. Patches without triangle or
/// shape are in the triangle and shape without index; lengths are turned into metres. Peak memory: the text, and 88
/// bytes a patch.
std::optional<PatchSet> read_patches(const std::string& path, const ReadLimits& limits, Diagnostics& diag);
/// The same from memory; `name` is for messages.
std::optional<PatchSet> parse_patches(std::string_view text, std::string name, Diagnostics& diag);
/// The same from a file that was read already.
std::optional<PatchSet> parse_patches(const FileText& file, Diagnostics& diag);

}  // namespace wrlkit

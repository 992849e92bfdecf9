// A small glTF file, and whether all names are still in it.
#pragma once
#include <string>
#include <vector>

#include "convert/profiles.h"
#include "convert/save.h"

namespace wrlkit {

struct Optimized : Saved {
  std::size_t n_names = 0;             // different DEF names before
  std::vector<std::string> lost;       // of what is shown; that is reported, too
  std::vector<std::string> not_shown;  // only of nodes that no Switch shows, for which glTF has no place
};

/// Runs the pipeline on the document's own scene, writes a glTF file and looks for the names in it; not on standard
/// output, which cannot be read again.
Optimized optimize(Document&, Pipeline&, const Output&, const SaveOptions&, const SaveHooks& = {});

/// The same as a profile has it (convert/profiles.h), on a copy. `path` ends in .glb or .gltf.
Optimized optimize(const Document&, const std::string& path, const Profile& = *find_profile("three"));

}  // namespace wrlkit

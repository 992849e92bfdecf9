// Urls in outputs that mean other inputs of the run: those become files with other names, part.wrz
// part.wrl.
#pragma once
#include <cstdint>

#include "scenegraph/scene.h"
#include "tools/corpus/plan.h"

namespace wrlkit {

/// links: where the rest becomes part of the output, as in glTF, and the writer leads urls from the input's folder to
/// that of the output.
enum class NamedUrls : std::uint8_t { all, links };

/// Lets Inline, Anchor, EXTERNPROTO and whatever else has urls name what becomes of a file, where they name the file
/// itself, below the folder `out`; also where that name was found for a path of another machine. Links to what does not
/// come along lead to where it is; other urls stay as they are. O(nodes).
void name_written_files(Scene& scene, const CorpusPlan& plan, const CorpusJob& job, const std::string& out,
                        const std::vector<std::string>& allowed, NamedUrls named);

}  // namespace wrlkit

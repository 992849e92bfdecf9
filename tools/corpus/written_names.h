// Urls in VRML and X3D output that mean other inputs of the run: those become files with other names, part.wrz
// part.wrl.
#pragma once
#include "scenegraph/scene.h"
#include "tools/corpus/plan.h"

namespace wrlkit {

/// Lets Inline, Anchor, EXTERNPROTO and whatever else has urls name what becomes of a file, where they name the file
/// itself; for a job whose output is text, below the folder `out`. Links to what does not come along lead to where it
/// is; other urls stay as they are. O(nodes).
void name_written_files(Scene& scene, const CorpusPlan& plan, const CorpusJob& job, const std::string& out,
                        const std::vector<std::string>& allowed);

}  // namespace wrlkit

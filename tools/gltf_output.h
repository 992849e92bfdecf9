// What the command line says of glTF output, and what is told of what was written.
#pragma once
#include <optional>
#include <string>

#include "tools/cli/session.h"
#include "writers/gltf/gltf.h"

namespace wrlkit {

/// Takes what was not said otherwise from --profile.
void apply_profile(Flags&);
/// Of a file with the name of the output. Nothing when a flag makes no sense; that was printed.
std::optional<GltfOptions> gltf_options(const Flags&);
/// The pipeline that prepares a scene for glTF.
std::string_view gltf_pipeline(const Flags&);

/// Runs the pipeline and writes what comes out, and what lies beside it; the summary is part of the report. False:
/// nothing was made, which was reported.
bool write_gltf_file(Session&, const GltfOptions&, GltfSummary&);

/// Some lines for people: sizes raw and gzipped by kind, draws and triangles, what quantisation has changed.
std::string summary_text(const GltfSummary&);
std::string summary_json(const GltfSummary&);

}  // namespace wrlkit

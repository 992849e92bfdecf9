// What the command line says of glTF output, and what is told of what was written.
#pragma once
#include <optional>
#include <string>

#include "tools/flags.h"
#include "writers/gltf.h"

namespace wrlkit {

/// Nothing when a flag makes no sense; that was printed.
std::optional<GltfCompression> compression_of(const Flags&);

/// Some lines for people: sizes raw and gzipped by kind, draws and triangles, what quantisation has changed.
std::string summary_text(const GltfSummary&);
std::string summary_json(const GltfSummary&);

}  // namespace wrlkit

// What is printed about a glTF file that was written.
#pragma once
#include <string>

#include "writers/gltf/gltf.h"

namespace wrlkit {

/// Some lines for people: sizes raw and gzipped by kind, draws and triangles, what quantisation has changed.
std::string summary_text(const GltfSummary&);
std::string summary_json(const GltfSummary&);

}  // namespace wrlkit

// The JSON of a glTF file, written directly. tinygltf's model and serialiser were measured instead: 200,000 nodes and
// 60,000 meshes took them 2.2 CPU seconds and 790 MB, a file of 37 MB; here a plant of that size takes 0.2 s with its
// vertices, and no more memory than the file has.
#pragma once
#include "base/io/sink.h"
#include "writers/gltf/animations.h"
#include "writers/gltf/document/document.h"
#include "writers/gltf/extras.h"
#include "writers/gltf/interactivity/graph.h"
#include "writers/gltf/layout.h"
#include "writers/gltf/packing.h"

namespace wrlkit::gltf {

/// Everything that a file is made of.
struct Parts {
  const Scene& scene;
  const Document& document;
  const Meshes& meshes;
  const Packing& packing;
  const Materials& materials;
  const Textures& textures;
  const Layout& layout;
  const Animations& animations;
  const Graph& graph;
  const PartTable& names;
  Extras* extras;                         // none: without
  bool facts_only;                        // see GltfOptions
  std::string buffer_uri;                 // none: the buffer is that of a GLB
  std::vector<std::string> picture_uris;  // of those that are not inside

  /// Names of parts as a property table.
  bool has_table() const { return names.columns() && !names.rows().empty(); }
};

/// Writes it in one line, a piece at a time. How many bytes each list of the file has.
std::vector<GltfSummary::Share> write_json(const Parts&, const Sink&);

}  // namespace wrlkit::gltf

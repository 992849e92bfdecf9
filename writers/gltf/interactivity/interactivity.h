// What the ROUTEs of a scene do, as a graph of KHR_interactivity (events.h says which).
#pragma once
#include "writers/gltf/animations.h"
#include "writers/gltf/document/document.h"
#include "writers/gltf/interactivity/graph.h"

namespace wrlkit::gltf {

/// Empty where nothing happens by itself and nothing can be done. The nodes of the document and the animations must be
/// those that are written. A file with a graph plays no animation by itself: clocks that run from the beginning are
/// started by the graph.
Graph make_interactivity(const Scene&, const Document&, const Animations&, Diagnostics&);

}  // namespace wrlkit::gltf

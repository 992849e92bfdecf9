// Light that is computed once and kept in textures.
#pragma once
#include "convert/document.h"
#include "passes/lightmap/lightmap.h"

namespace wrlkit {

/// Expands Inlines and prototypes, computes the light on every surface and puts it there as lightmaps: the pass
/// `lightmap`. Messages are the document's. When it is stopped (Watch::stop) between passes, the document is expanded
/// and not lit. Cost: docs/lighting.md.
Ending bake(Document&, const LightmapOptions& = {});

}  // namespace wrlkit

// Files that a scene names and that are not there.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Pictures and scenes, as errors: what is drawn is missing. For formats that refer to them. Linear in the urls.
void report_missing_parts(const Scene&, Resources&, Diagnostics&);
/// Sounds, films and programs, as warnings. Linear in the urls.
void report_missing_media(const Scene&, Resources&, Diagnostics&);

}  // namespace wrlkit

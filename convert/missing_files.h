// Files that a scene names and that are not there.
#pragma once
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Pictures and scenes, as errors: what is drawn is missing. For formats that refer to them. Linear in the urls.
void report_missing_parts(const Scene&, Resources&, Diagnostics&);
/// Sounds, films and programs, as warnings. Linear in the urls.
void report_missing_media(const Scene&, Resources&, Diagnostics&);

/// Pictures, as warnings, each once: for text in a stream, whose reader has to find them by its urls. n log n in the
/// urls.
void report_missing_pictures(const Scene&, Resources&, Diagnostics&);
/// The urls of files that a scene refers to and that are there, each once. Linear in the urls.
std::vector<std::string> files_outside(const Scene&, Resources&);

}  // namespace wrlkit

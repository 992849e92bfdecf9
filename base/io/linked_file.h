// Whether a file is of a kind that scenes refer to: a picture, a sound, a film or a scene.
#pragma once
#include <string>

namespace wrlkit {

/// By its first 4,096 bytes; a gzipped file by its name, too. False when it cannot be read.
bool is_linked_kind(const std::string& path);

}  // namespace wrlkit

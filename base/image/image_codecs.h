// The module with the codecs (image.h), for a program that forks: loading it takes longer than most conversions.
#pragma once

namespace wrlkit {

/// Loads it now, for all processes that will be forked from this one.
void load_image_codecs();
bool image_codecs_are_loaded();

}  // namespace wrlkit

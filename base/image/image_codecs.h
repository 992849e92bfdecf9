// The module with the codecs (image.h): where it is, and when it is loaded.
#pragma once
#include <string>

namespace wrlkit {

/// Names the module, wrlkit_images.so, by its absolute path. It is looked for, in this order: next to the program and
/// in the lib folder that belongs to it, at this path, where this library was configured to be installed, and at the
/// absolute path in the environment variable WRLKIT_IMAGES. Programs that find wrlkit by CMake's find_package need not
/// call this. False: the path is relative, or the module has been opened already. Not while another thread decodes or
/// encodes.
bool set_image_codecs(const std::string& path);

/// For a program that forks, since loading takes longer than most conversions: loads them now, for all processes that
/// will be forked from this one.
void load_image_codecs();
bool image_codecs_are_loaded();

}  // namespace wrlkit

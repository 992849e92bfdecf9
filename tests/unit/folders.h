#pragma once
#include <filesystem>

/// The checkout that the tests were built from: corpus/, tests/.
const std::filesystem::path& source_folder();

/// A folder of the found data, which lies where WRLKIT_SHARED says, or else next to the checkout; it may not be there.
std::filesystem::path shared_folder(const char* name);

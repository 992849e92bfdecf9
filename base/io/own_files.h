// Files that belong to wrlkit and lie near its program or library: the module of codecs, the process of Scripts.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace wrlkit {

/// Where a file of that name is, the best place first: next to the program or library that this code is in, in
/// lib/wrlkit next to it, where it was installed, in one of `more`, and at the path that the environment variable
/// names. Only absolute paths in folders that not everybody may write to.
std::vector<std::filesystem::path> own_files(const std::string& name, const char* variable,
                                             const std::vector<std::filesystem::path>& more = {});

}  // namespace wrlkit

// Passes that are written in Python. The program has no Python in it: when a file with such passes is named, by
// --python or by a recipe, the same command line is run once more, from its beginning, by the Python package, which is
// this program as a Python module. Without such passes it is never loaded.
#pragma once
#include <string>
#include <vector>

namespace wrlkit {

/// Set by the Python package. Runs a file, so that the passes in it are known; a second time it does nothing. False,
/// and why, when that fails.
inline bool (*load_python_file)(const std::string& path, std::string& why) = nullptr;

/// Thrown when there is no Python in this process and it is needed; main() catches it.
struct NeedsPython {};

/// False, and why, when a file cannot be loaded. Throws NeedsPython.
bool load_python_passes(const std::vector<std::string>& paths, std::string& why);

/// Becomes `python3 -m wrlkit` with the same words. Returns only when that is not possible: an exit code, and why was
/// printed.
int run_in_python(char** words);

}  // namespace wrlkit

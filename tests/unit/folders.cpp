// The only unit test source that knows where the checkout is: ccache gives the objects of all others to every checkout.
#include "tests/unit/folders.h"

#include <cstdlib>

namespace fs = std::filesystem;

const fs::path& source_folder() {
  static const fs::path folder = WRLKIT_SOURCE_DIR;
  return folder;
}

fs::path shared_folder(const char* name) {
  const char* shared = std::getenv("WRLKIT_SHARED");
  return (shared ? fs::path(shared) : source_folder() / ".." / "shared") / name;
}

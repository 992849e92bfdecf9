#include "base/io/own_files.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

/// Folder of the program or shared library that this code is in.
fs::path own_folder() {
  std::error_code ec;
  Dl_info self{};
  link_map* object = nullptr;
  auto address = reinterpret_cast<const void*>(&own_folder);
  // The name of a program would be argv[0], which may be anything; the map leaves it empty.
  bool known = dladdr1(address, &self, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP) != 0;
  bool library = known && object && object->l_name && object->l_name[0] == '/';
  return fs::canonical(library ? object->l_name : "/proc/self/exe", ec).parent_path();
}

/// Whether there is a file that nobody else can have put there: a relative path would name another one in every working
/// directory, and in /tmp everyone may leave one.
bool is_trusted(const fs::path& path) {
  std::error_code ec;
  if (!path.is_absolute() || !fs::exists(path, ec)) return false;
  const auto folder = fs::status(path.parent_path(), ec).permissions();
  return !ec && (folder & fs::perms::others_write) == fs::perms::none;
}

}  // namespace

std::vector<fs::path> own_files(const std::string& name, const char* variable, const std::vector<fs::path>& more) {
  const fs::path folder = own_folder(), lib = folder / ".." / "lib";
  std::vector<fs::path> paths{folder / name, folder / ".." / name, folder / ".." / ".." / name,
                              folder / "wrlkit" / name, lib / "wrlkit" / name};
  std::error_code ec;
  for (fs::directory_iterator i(lib, ec), end; !ec && i != end; i.increment(ec))  // lib/x86_64-linux-gnu
    paths.push_back(i->path() / "wrlkit" / name);
  paths.insert(paths.end(), more.begin(), more.end());
  paths.push_back(fs::path(WRLKIT_INSTALLED_FILES) / name);
  // By a variable that the user has set; a program with more rights than its user does not listen to it.
  if (const char* path = secure_getenv(variable)) paths.emplace_back(path);
  std::erase_if(paths, [](const fs::path& path) { return !is_trusted(path); });
  return paths;
}

}  // namespace wrlkit

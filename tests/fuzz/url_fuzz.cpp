// What must hold of any bytes as a url, or several, one a line: what is found lies below the folder that was allowed,
// whatever the url looks like and whatever links there are. The folder is made once, with a secret next to it.
#include <filesystem>
#include <fstream>

#include "base/io/allowed_files.h"
#include "base/io/uri.h"
#include "base/io/url.h"
#include "tests/fuzz/harness.h"

using namespace wrlkit;
namespace fs = std::filesystem;

namespace {

class Folder {
 public:
  Folder() {
    fs::create_directories(allowed / "Sub folder");
    for (const char* name : {"world.wrl", "a.png", "B.PNG", "Sub folder/c%20d.jpg", "..d", "secret"})
      std::ofstream(allowed / name) << "x";
    std::ofstream(path_ / "secret") << "x";
    fs::create_symlink(path_ / "secret", allowed / "link.png");
    fs::create_directory_symlink(path_, allowed / "up");
    fs::create_directory_symlink(allowed, allowed / "loop");
  }
  ~Folder() {
    std::error_code left;
    fs::remove_all(path_, left);
  }

 private:
  static fs::path made() {
    std::string name = (fs::temp_directory_path() / "url_fuzz.XXXXXX").string();
    require(mkdtemp(name.data()) != nullptr, "no folder for the files");
    return fs::canonical(name);
  }
  fs::path path_ = made();

 public:
  fs::path allowed = path_ / "allowed";
};

void try_url(std::string_view url, const fs::path& allowed) {
  require(!url_paths(url).empty(), "a url without a path");
  if (url_kind(url) == UrlKind::data) decode_data_url(url);
  require(uri_of(url).find_first_of(" \"<>\n") == std::string::npos, "a character that has no place in a uri");
  AllowedFiles files({allowed.string()});
  const auto found = find_url(files, url, (allowed / "world.wrl").string());
  if (found.state != AllowedFiles::found && found.state != AllowedFiles::repaired) return;
  const auto canonical = fs::canonical(found.path).string();
  require(canonical.starts_with(allowed.string() + "/"), "found outside: " + canonical);
  require(fs::is_regular_file(canonical), "found, and not a file: " + canonical);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const auto text = text_of(data, size);
  for (std::size_t at = 0; at <= text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    try_url(text.substr(at, end - at), folder.allowed);
    at = end + 1;
  }
  return 0;
}

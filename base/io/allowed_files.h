// The folders that files may be read from, and finding files in them as the systems did for which the scenes were
// written: there, upper and lower case were the same, and paths were those of the author's machine.
#pragma once
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace wrlkit {

class AllowedFiles {
 public:
  enum State { found, repaired, outside, missing };  // the better, the earlier
  struct Result {
    State state = missing;
    std::string path;       // as the folder was given, so that messages do not depend on where a user keeps his files
    std::string canonical;  // the file's identity
    bool above = false;     // below no folder that was allowed, but below that of linked files
  };

  /// An empty name is the current folder.
  explicit AllowedFiles(const std::vector<std::string>& folders);

  /// The same, later.
  void allow(const std::vector<std::string>& folders);

  /// Pictures, sounds, films and scenes below that folder, which lies above `folder`, may be read as well; what is of
  /// another kind by its first bytes stays outside. `top` is absolute and without links.
  void allow_linked(const std::string& folder, const std::string& top);

  /// Looks for `path`, which is relative to the folder of the file `referrer`: exactly; then without regard to case;
  /// then its last name next to the referrer (`repaired`). Only regular files count. `outside`: it exists, but neither
  /// it nor what a symbolic link leads to lies below one of the folders.
  Result find(const std::string& path, const std::string& referrer);

 private:
  struct Root {
    std::string given, canonical;
    bool linked = false;  // only files of the kinds that scenes refer to
  };
  const Root* root_of(const std::string& canonical) const;
  Result exact(const std::string& path) const;
  Result any_case(const std::string& path);
  std::string name_in(const std::string& folder, const std::string& name);

  std::vector<Root> roots_;
  std::unordered_map<std::string, std::map<std::string, std::string>> listings_;  // folder: lower-case name to name
};

/// What was asked for, and what it has led to: asking again shows whether it still does.
struct FileLookup {
  std::string referrer, url;
  AllowedFiles::Result result;
};

/// The best of what the paths that a url may mean lead to.
AllowedFiles::Result find_url(AllowedFiles&, std::string_view url, const std::string& referrer);
/// The same for urls of what lies in no folder: as if it lay in each of these.
AllowedFiles::Result find_url_below(AllowedFiles&, std::string_view url, std::span<const std::string> folders);

}  // namespace wrlkit

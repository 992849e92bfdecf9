#include "base/io/project_folder.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr int most_levels = 8, unmarked_levels = 2;

bool is_marked(const fs::path& folder) {
  constexpr std::array<std::string_view, 5> marks = {".git", ".hg", ".svn", ".bzr", "CVS"};
  return std::ranges::any_of(marks, [&](std::string_view mark) {
    std::error_code none;
    return fs::exists(folder / mark, none);
  });
}

fs::path home() {
  const char* given = std::getenv("HOME");
  std::error_code none;
  return given && *given ? fs::canonical(given, none) : fs::path();
}

bool contains(const fs::path& folder, const fs::path& other) {
  return std::ranges::mismatch(folder, other).in1 == folder.end();
}

/// A folder of the system or of everybody, or of all that a user has.
bool is_too_high(const fs::path& folder, const fs::path& home) {
  std::error_code ec;
  const auto status = fs::status(folder, ec);
  return ec || folder == folder.root_path() || contains(folder, home) ||
         (status.permissions() & fs::perms::others_write) != fs::perms::none;
}

}  // namespace

std::string project_folder(const std::string& folder) {
  std::error_code ec;
  fs::path at = fs::canonical(folder.empty() ? "." : folder, ec);
  if (ec) return {};
  const fs::path users = home();
  fs::path unmarked = at;
  for (int level = 0; level <= most_levels; ++level) {
    if (level > 0 && is_too_high(at, users)) break;
    if (is_marked(at)) return at.string();
    if (level <= unmarked_levels) unmarked = at;
    at = at.parent_path();
  }
  return unmarked.string();
}

}  // namespace wrlkit

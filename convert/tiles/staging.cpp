#include "convert/tiles/staging.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/io/file_lock.h"
#include "base/io/output.h"

namespace wrlkit::tiles {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "tiles-";
constexpr std::size_t digits = 16;

bool is_tiles_folder(const std::string& name) {
  return name.starts_with(prefix) && name.size() == prefix.size() + digits &&
         std::all_of(name.begin() + prefix.size(), name.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
}

void remove_others(const fs::path& folder, const std::string& name) {
  std::error_code none;
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const auto other = entry.path().filename().string();
    if (other != name && is_tiles_folder(other) && !entry.is_symlink(none) && entry.is_directory(none))
      others.push_back(entry.path());
  }
  for (const auto& path : others) fs::remove_all(path, none);
}

/// Whether there is a set of tiles that another program has made.
bool is_foreign(const fs::path& tileset) {
  std::error_code none;
  const auto type = fs::status(tileset, none).type();  // once: another run may make it at this moment
  if (type != fs::file_type::regular) return type != fs::file_type::not_found;
  constexpr std::size_t head = 4096;  // the generator stands in front of the tiles
  std::ifstream in(tileset, std::ios::binary);
  std::string text(head, '\0');
  in.read(text.data(), head);
  text.resize(static_cast<std::size_t>(in.gcount()));
  return !text.empty() && text.find("\"wrlkit\"") == text.npos;
}

/// Whether it was not there. A run that had made it for all may end and remove it between the steps of this: then it is
/// made once more.
bool make_folder(const fs::path& folder, std::error_code& fault) {
  constexpr int tries = 100;
  bool made = false;
  for (int i = 0; i < tries; ++i) {
    made = fs::create_directories(folder, fault);
    if (!fault || (fault != std::errc::file_exists && fault != std::errc::not_a_directory &&
                   fault != std::errc::no_such_file_or_directory))
      break;
  }
  return made;
}

/// -1: somebody else has it.
int lock_of(const fs::path& folder) {
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0 || lock_file(fd, FileLock::exclusive)) return fd;
  close(fd);
  return -1;
}

}  // namespace

std::string tiles_folder(std::uint64_t hash) { return fmt::format("{}{:0{}x}", prefix, hash, digits); }

bool Staging::open(const std::string& folder, Diagnostics& diag) {
  if (const auto tileset = fs::path(folder) / "tileset.json"; is_foreign(tileset)) {
    diag.report(Diag::cannot_write, {}, tileset.string(), "it is not of wrlkit tiles; choose another folder");
    return false;
  }
  folder_ = folder;
  std::error_code fault;
  made_ = make_folder(folder_, fault);
  std::error_code none;
  const auto type = fs::status(folder_, none).type();
  // Not found: a run that had made it has ended and removed it; make_own makes it again.
  if (!fault && type != fs::file_type::directory && type != fs::file_type::not_found)
    fault = std::make_error_code(std::errc::not_a_directory);
  remove_left_behind();
  if (!fault) fault = make_own();
  if (fault) {
    diag.report(Diag::cannot_write, {}, folder, fault.message());
    return false;
  }
  fs::permissions(at_, fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec,
                  fs::perm_options::add, fault);
  return true;
}

/// Until it is locked, another run may take it for one that was left behind; then there is another one.
std::error_code Staging::make_own() {
  constexpr int tries = 10;  // all of them where the file system has no locks: the last one is taken as it is
  constexpr int most_gone = 1000;
  for (int i = 0, n_gone = 0; i < tries && n_gone < most_gone; ++i) {
    if (lock_ >= 0) close(std::exchange(lock_, -1));
    std::error_code none;
    if (!at_.empty()) fs::remove_all(std::exchange(at_, {}), none);
    std::string name = (folder_ / (std::string(unfinished_folder) + "XXXXXX")).string();
    if (!mkdtemp(name.data())) {
      const std::error_code fault(errno, std::generic_category());
      if (fault != std::errc::no_such_file_or_directory) return fault;
      make_folder(folder_, none);
      if (none) return none;
      --i;
      ++n_gone;
      continue;
    }
    at_ = name;
    lock_ = lock_of(at_);
    if (lock_ >= 0 && fs::exists(at_, none)) break;
  }
  return at_.empty() ? std::make_error_code(std::errc::no_such_file_or_directory) : std::error_code();
}

void Staging::remove_left_behind() const {
  std::error_code none;
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(folder_, none))
    if (entry.path().filename().string().starts_with(unfinished_folder)) left.push_back(entry.path());
  for (const auto& path : left) {
    const int lock = lock_of(path);
    if (lock < 0) continue;
    fs::remove_all(path, none);
    close(lock);
  }
}

Staging::~Staging() {
  if (lock_ >= 0) close(lock_);
  std::error_code none;
  if (!at_.empty()) fs::remove_all(at_, none);
  if (made_ && !folder_.empty()) fs::remove(folder_, none);  // as long as it is empty
}

bool Staging::publish(const std::string& name, const std::string& tileset, Diagnostics& diag) {
  auto file = OutputFile::open((folder_ / "tileset.json").string(), {}, diag);
  if (!file) return false;
  file->write(tileset);
  std::error_code fault;
  const auto to = folder_ / name;
  if (fs::exists(to, fault)) fs::remove_all(to, fault);  // the same tiles
  fs::rename(at_, to, fault);
  if (fault) {
    diag.report(Diag::cannot_write, {}, to.string(), fault.message());
    return false;
  }
  at_.clear();
  if (!file->commit(diag)) return false;
  remove_others(folder_, name);
  return true;
}

}  // namespace wrlkit::tiles

#include "tools/corpus/first_run.h"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "tools/corpus/journal.h"

namespace wrlkit {
namespace {

std::string mark_in(const std::string& out) { return corpus_folder(out) + "/begun"; }

}  // namespace

std::optional<FileTime> change_time(const std::string& path) {
  struct stat there {};
  if (stat(path.c_str(), &there) != 0) return std::nullopt;
  return FileTime{there.st_ctim.tv_sec, there.st_ctim.tv_nsec};
}

bool note_first_run(const std::string& out) {
  namespace fs = std::filesystem;
  std::error_code fault;
  if (fs::exists(corpus_folder(out), fault)) return true;
  fs::create_directories(corpus_folder(out), fault);
  return !fault && std::ofstream(mark_in(out)).good();
}

std::optional<FileTime> time_of_first_run(const std::string& out) { return change_time(mark_in(out)); }

}  // namespace wrlkit

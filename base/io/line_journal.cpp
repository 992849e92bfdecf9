#include "base/io/line_journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "base/io/file_lock.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds patience(5);  // workers of a run that was killed hold the lock until they are gone, too

/// A line that was cut off stays what it is, and the next one begins on a line of its own.
void end_cut_line(int fd) {
  const auto size = lseek(fd, 0, SEEK_END);
  char last = '\n';
  if (size > 0 && pread(fd, &last, 1, size - 1) == 1 && last != '\n' && write(fd, "\n", 1) != 1) return;
}

}  // namespace

std::optional<LineJournal> LineJournal::open(const std::string& path, std::string& why) {
  std::error_code fault;
  const auto folder = fs::path(path).parent_path();
  fs::create_directories(folder, fault);
  const int fd = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (fd < 0) {
    why = fault ? folder.string() + ": " + fault.message() : path + ": " + std::strerror(errno);
    return std::nullopt;
  }
  LineJournal journal(fd);
  if (!lock_file(fd, FileLock::exclusive, patience)) {
    why = path + ": another run is writing it";
    return std::nullopt;
  }
  end_cut_line(fd);
  return journal;
}

LineJournal::LineJournal(LineJournal&& o) noexcept : fd_(std::exchange(o.fd_, -1)) {}

LineJournal::~LineJournal() {
  if (fd_ >= 0) {
    settle();
    close(fd_);
  }
}

bool LineJournal::append(std::string line) {
  line += '\n';
  const auto n = write(fd_, line.data(), line.size());
  if (n >= 0 && n < static_cast<ssize_t>(line.size())) errno = ENOSPC;  // the half line is none
  return n == static_cast<ssize_t>(line.size());
}

void LineJournal::settle() { fdatasync(fd_); }

void read_journal_lines(const std::string& folder, const std::function<void(const std::string&)>& take,
                        std::string_view kind) {
  const auto beginning = std::string(kind) + "-";
  std::vector<fs::path> paths;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with(beginning) && name.ends_with(".jsonl")) paths.push_back(entry.path());
  }
  std::ranges::sort(paths, {}, [&](const fs::path& p) { return std::pair(fs::last_write_time(p, none), p); });
  for (const auto& path : paths) {
    std::ifstream in(path);
    for (std::string text; std::getline(in, text);) take(text);
  }
}

}  // namespace wrlkit

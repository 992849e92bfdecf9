// What has been done, one line each, in a file. A line is written at once behind the last one and nothing is ever
// changed, so whatever ends a run leaves whole lines and at most one half, which its reader does not take for one.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace wrlkit {

class LineJournal {
 public:
  /// Opens a file, in a folder that is made as well, to write behind what it has. Nothing, and why, when it cannot be
  /// written or another run has it.
  static std::optional<LineJournal> open(const std::string& path, std::string& why);
  LineJournal(LineJournal&&) noexcept;
  ~LineJournal();

  /// The line has no end of its own. False when it could not be written; errno says why. Any thread.
  bool append(std::string line);
  /// On the disk, and not on its way there.
  void settle();

 private:
  explicit LineJournal(int fd) : fd_(fd) {}
  int fd_;
};

/// Every line of every file `kind`-*.jsonl of a folder, in order; the file that was written last wins.
/// Memory: one line.
void read_journal_lines(const std::string& folder, const std::function<void(const std::string&)>& take,
                        std::string_view kind = "journal");

}  // namespace wrlkit

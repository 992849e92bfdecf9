// What has been done, a line of JSON a file (base/io/line_journal.h), in OUT/.wrlkit/. Each shard has a journal of its
// own; readers take all of them, and the last line about an output counts. What is begun stands in files next to them.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/io/content_hash.h"
#include "base/io/line_journal.h"
#include "base/text/json.h"
#include "tools/corpus/plan.h"

namespace wrlkit {

/// How it went. made_partly: the output is there and something of the input is not in it.
enum class JobState : std::uint8_t { made, made_partly, failed, crashed, timeout, no_memory };
std::string_view to_string(JobState);
inline bool is_made(JobState s) { return s == JobState::made || s == JobState::made_partly; }

/// A name as JSON can hold it: as it is, or, where it is not UTF-8, "bytes:" and its bytes as in a url: "bytes:lat%E9".
std::string name_to_json(const std::string& name);
std::string name_from_json(std::string_view text);

/// A file that the input refers to: what asked for it, by which url or path, what was found, and its contents.
struct UsedFile {
  std::string referrer, url;
  std::string path;  // empty: nothing was found
  ContentHash hash;

  void fields(auto&& f) const {
    f("referrer", name_to_json(referrer));
    f("url", name_to_json(url));
    f("path", name_to_json(path));
    f("hash", hash.hex());
  }
};

/// A file that was written next to an output.
struct CompanionFile {
  std::string path;  // below the folder of the run
  std::uint64_t bytes = 0;

  void fields(auto&& f) const {
    f("path", name_to_json(path));
    f("bytes", bytes);
  }
};

struct JournalLine {
  std::string input, output;  // the output below the folder of the run
  ContentHash work;           // program and recipe
  JobState state = JobState::failed;
  std::string cause;                         // why nothing was made
  double started = 0, seconds = 0, cpu = 0;  // Unix time; wall clock; processor
  std::uint64_t memory = 0;                  // most at a time, bytes
  std::uint64_t input_bytes = 0, output_bytes = 0;
  ContentHash input_hash, output_hash;
  std::vector<UsedFile> files;
  std::vector<CompanionFile> companions;
  std::string messages;  // JSON, as --report has them
  bool codecs = false;   // a worker has loaded the codecs for pictures: told to the run, not kept

  void fields(auto&& f) const {
    f("input", name_to_json(input));
    f("output", name_to_json(output));
    f("state", state);
    if (!cause.empty()) f("cause", cause);
    f("work", work.hex());
    f("started", started);
    f("seconds", seconds);
    f("cpu", cpu);
    f("memory", memory);
    f("input_bytes", input_bytes);
    f("input_hash", input_hash.hex());
    if (is_made(state)) {
      f("output_bytes", output_bytes);
      f("output_hash", output_hash.hex());
    }
    if (codecs) f("codecs", true);
    f("files", files);
    if (!companions.empty()) f("companions", companions);
    f("messages", JsonText{messages.empty() ? "[]" : messages});
  }
};

std::string to_json(const JournalLine&);
/// Nothing when the text is not a whole line.
std::optional<JournalLine> journal_line(std::string_view text);

class Journal {
 public:
  /// Opens a shard's journal to write behind what it has. Nothing, and why, when it cannot be written or another run
  /// has it.
  static std::optional<Journal> open(const std::string& folder, Shard shard, std::string& why);

  /// False when the line could not be written; errno says why.
  bool append(const JournalLine&);
  /// That an output is begun, which a run that is killed leaves no other line of. False as above.
  bool append_begun(const std::string& output);
  /// On the disk, and not on its way there.
  void settle();

 private:
  Journal(LineJournal lines, LineJournal begun) : lines_(std::move(lines)), begun_(std::move(begun)) {}
  LineJournal lines_, begun_;
};

/// Every line of every journal of a run, journal by journal, in order. Memory: one line. Returns how many were damaged
/// or cut off, which are passed over.
std::size_t read_journals(const std::string& folder, const std::function<void(JournalLine&&)>& take);
/// The outputs that were ever begun.
void read_begun(const std::string& folder, const std::function<void(std::string&&)>& take);

/// Where a run keeps what is its own: OUT/.wrlkit
std::string corpus_folder(const std::string& out);

}  // namespace wrlkit

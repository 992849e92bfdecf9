// What a worker of a corpus run does with one file, and whether it has to be done at all.
#pragma once
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "tools/cli/flags.h"
#include "tools/corpus/journal.h"

namespace wrlkit {

/// What everything of a run has in common.
struct CorpusWork {
  Flags flags;        // of a conversion
  ContentHash hash;   // of program, recipe and format: the same gives the same bytes
  std::string out;    // folder
  bool text = false;  // outputs are VRML or X3D, which refer to files next to them
};

/// Version, and contents of the file that this code is in: builds of one version may differ.
std::string program_identity();

/// Where a run writes down its whole recipe.
std::string run_recipe(const std::string& out);
/// Writes it, with the folders of the inputs; false when it cannot be written, which was printed.
bool write_run_recipe(const CorpusWork& work, const CorpusPlan& plan);

/// Nothing, and why, when the recipe is none.
std::optional<CorpusWork> corpus_work(const Flags& corpus_flags, std::string& why);

/// Knows what was done before, by the journals.
class DoneBefore {
 public:
  DoneBefore(const CorpusWork& work, const CorpusPlan& plan);
  /// The state that a job ended in when it was done with the same program and recipe from the same input and the same
  /// files behind it, and what was made then is still there.
  std::optional<JobState> state_of(const CorpusJob& job);
  /// Whether an earlier run has worked on that output.
  bool has(const CorpusJob& job) const { return known_.contains(job.output); }
  /// Whether a run has made the output, or has begun it and was killed.
  bool has_begun(const CorpusJob& job) const { return made_.contains(job.output) || unended_.contains(job.output); }
  /// Whether what lies where that output and its companions go is a run's own, and was not changed since. Reads the
  /// output.
  bool owns(const CorpusJob& job) const;
  /// Whether the input had another name when the job was done.
  bool is_moved(const CorpusJob& job) const;

 private:
  struct Known {
    std::string input;
    ContentHash work, input_hash;
    std::uint64_t output_bytes;
    JobState state;
    std::vector<UsedFile> files;
    std::vector<CompanionFile> companions;
  };
  bool still_the_same(const CorpusJob& job, const UsedFile& file);
  const ContentHash& hash(const std::string& path);

  const CorpusWork& work_;
  const CorpusPlan& plan_;
  std::unordered_map<std::string, ContentHash> made_;    // outputs that were made at any time, as they were last
  std::unordered_set<std::string> unended_;              // outputs that were begun, and did not end in order
  std::unordered_map<std::string, Known> known_;         // by output
  std::unordered_map<std::string, ContentHash> hashes_;  // of files that inputs refer to
};

/// Does a job and fills in what the journal wants to know of it. `may_replace`: files that are there.
void do_job(const CorpusWork& work, const CorpusPlan& plan, const CorpusJob& job, bool may_replace, JournalLine& line);

}  // namespace wrlkit

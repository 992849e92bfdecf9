// What a corpus run has come to, as data: the pages and tables of corpus report are made of it.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/corpus/journal.h"
#include "tools/corpus/look.h"

namespace wrlkit {

struct ReportRow {
  std::string input, output, cause;
  JobState state = JobState::failed;
  double seconds = 0, cpu = 0;
  std::uint64_t memory = 0, input_bytes = 0, output_bytes = 0;
  std::uint32_t errors = 0, warnings = 0, lost = 0;
  ContentHash output_hash;
  std::optional<Look> look;
  bool is_changed = false;  // the output is not as large as it was made, or is gone

  void fields(auto&& f) const {
    f("input", name_to_json(input));
    f("output", name_to_json(output));
    f("state", state);
    if (!cause.empty()) f("cause", cause);
    f("seconds", seconds);
    f("cpu", cpu);
    f("memory", memory);
    f("input_bytes", input_bytes);
    f("output_bytes", output_bytes);
    f("errors", errors);
    f("warnings", warnings);
    f("lost", lost);
    if (is_changed) f("changed", true);
    if (!look) return;
    f("rms", look->rms);
    f("max", look->max);
    f("of_diagonal", look->of_diagonal);
  }
};

/// One kind of message over all files.
struct ReportedKind {
  std::string name, severity;
  std::uint64_t files = 0, times = 0;
  std::string example;  // "file:line: text"

  void fields(auto&& f) const {
    f("name", name);
    f("severity", severity);
    f("files", files);
    f("times", times);
    f("example", example);
  }
};

/// How a file has become worse, or otherwise different, than in the run that it is compared with.
struct Change {
  std::string output, what;
  bool worse = false;

  void fields(auto&& f) const {
    f("output", name_to_json(output));
    f("what", what);
    f("worse", worse);
  }
};

struct CorpusReport {
  std::string out;
  std::vector<ReportRow> rows;  // by output
  std::size_t removed = 0;      // inputs that are no longer there; they have no rows
  std::size_t damaged = 0;      // lines of the journals that cannot be read: files that were being done at the time
  std::map<std::string, ReportedKind, std::less<>> kinds;  // by name
  std::string compared;                                    // folder of the other run; empty: none
  std::vector<Change> changes;                             // those that are worse first

  std::size_t n(JobState s) const;
  /// Outputs that are gone, or have another size than they were made with.
  std::size_t n_changed() const;
  /// How many files came to each state.
  std::vector<std::pair<std::string_view, std::size_t>> states() const;
  /// The kinds, by name.
  std::vector<ReportedKind> messages() const;
  void fields(auto&& f) const {
    f("folder", out);
    f("states", states());
    f("removed", removed);
    f("changed", n_changed());
    f("damaged", damaged);
    f("messages", messages());
    f("files", rows);
    if (compared.empty()) return;
    f("compared", compared);
    f("changes", changes);
  }
};

/// The last line about each output whose input is still there; all of them where no input is, because a run may be
/// reported on another machine. Memory: some 300 bytes a file.
CorpusReport read_report(const std::string& out);
/// What is otherwise in `report` than in the run before it.
void compare(CorpusReport& report, const CorpusReport& before);

std::string report_csv(const CorpusReport&);
std::string report_json(const CorpusReport&);
/// One HTML file that needs no other (report_page.cpp).
std::string report_page(const CorpusReport&);

}  // namespace wrlkit

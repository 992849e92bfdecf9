// What a corpus run has come to, as data: the pages and tables of corpus report are made of it.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
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
};

/// One kind of message over all files.
struct ReportedKind {
  std::string severity, example;  // "file:line: text"
  std::uint64_t files = 0, times = 0;
};

/// How a file has become worse, or otherwise different, than in the run that it is compared with.
struct Change {
  std::string output, what;
  bool worse = false;
};

struct CorpusReport {
  std::string out;
  std::vector<ReportRow> rows;                             // by output
  std::map<std::string, ReportedKind, std::less<>> kinds;  // by name
  std::string compared;                                    // folder of the other run; empty: none
  std::vector<Change> changes;                             // those that are worse first

  std::size_t n(JobState s) const;
};

/// The last line about each output. Memory: some 300 bytes a file.
CorpusReport read_report(const std::string& out);
/// What is otherwise in `report` than in the run before it.
void compare(CorpusReport& report, const CorpusReport& before);

std::string report_csv(const CorpusReport&);
std::string report_json(const CorpusReport&);
/// One HTML file that needs no other (report_page.cpp).
std::string report_page(const CorpusReport&);

}  // namespace wrlkit

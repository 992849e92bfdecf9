#include "tools/corpus/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <unordered_map>

#include "base/text/csv.h"
#include "base/text/json.h"
#include "base/text/json_reader.h"

namespace wrlkit {
namespace {

void count_messages(const JournalLine& line, ReportRow& row, std::map<std::string, ReportedKind, std::less<>>& kinds) {
  JsonDocument doc;
  if (line.messages.empty() || doc.parse(line.messages)) return;
  for (auto m : doc.root()) {
    const auto times = m["count"].whole().value_or(0);
    if (times == 0) continue;  // reported with the first of its name
    const auto severity = m["severity"].text();
    (severity == "error"  ? row.errors
     : severity == "lost" ? row.lost
                          : row.warnings) += static_cast<std::uint32_t>(times);
    auto& kind = kinds[std::string(m["name"].text())];
    if (kind.files == 0) {
      kind.name = m["name"].text();
      kind.severity = severity;
      const auto line_number = m["line"].whole().value_or(0);
      kind.example = fmt::format("{}{}: {}", m["file"].text().empty() ? line.input : m["file"].text(),
                                 line_number ? fmt::format(":{}", line_number) : "", m["text"].text());
    }
    kind.files += 1;
    kind.times += times;
  }
}

ReportRow row_of(JournalLine&& l) {
  ReportRow r;
  r.input = std::move(l.input);
  r.output = std::move(l.output);
  r.cause = std::move(l.cause);
  r.state = l.state;
  r.seconds = l.seconds;
  r.cpu = l.cpu;
  r.memory = l.memory;
  r.input_bytes = l.input_bytes;
  r.output_bytes = l.output_bytes;
  r.output_hash = l.output_hash;
  return r;
}

/// A name that the journal could not hold as it is counts as that of a file.
bool is_there(const std::string& input) {
  constexpr std::string_view replaced = "\xef\xbf\xbd";
  std::error_code none;
  return input.find(replaced) != input.npos || std::filesystem::exists(input, none);
}

/// Nothing when there is none.
std::optional<std::uint64_t> size_of_output(const std::string& out, const ReportRow& row) {
  std::error_code fault;
  const auto size = std::filesystem::file_size(std::filesystem::path(out) / row.output, fault);
  return fault ? std::nullopt : std::optional<std::uint64_t>(size);
}

std::string number_or_nothing(const std::optional<Look>& look, double Look::*member) {
  return look && std::isfinite(*look.*member) ? fmt::format("{:g}", *look.*member) : "";
}

}  // namespace

std::size_t CorpusReport::n(JobState s) const {
  return static_cast<std::size_t>(std::ranges::count(rows, s, &ReportRow::state));
}

std::size_t CorpusReport::n_changed() const {
  return static_cast<std::size_t>(std::ranges::count(rows, true, &ReportRow::is_changed));
}

std::vector<std::pair<std::string_view, std::size_t>> CorpusReport::states() const {
  std::vector<std::pair<std::string_view, std::size_t>> list;
  for (auto s : {JobState::made, JobState::made_partly, JobState::failed, JobState::crashed, JobState::timeout,
                 JobState::no_memory})
    list.emplace_back(to_string(s), n(s));
  return list;
}

std::vector<ReportedKind> CorpusReport::messages() const {
  std::vector<ReportedKind> list;
  list.reserve(kinds.size());
  for (const auto& [name, kind] : kinds) list.push_back(kind);
  return list;
}

CorpusReport read_report(const std::string& out) {
  // Which line counts is known when all have been read; messages are counted in a second reading.
  std::unordered_map<std::string, std::size_t> last;
  std::size_t n = 0;
  bool has_inputs = false;
  CorpusReport report{.out = out};
  report.damaged = read_journals(corpus_folder(out), [&](JournalLine&& l) {
    has_inputs = has_inputs || is_there(l.input);
    last[std::move(l.output)] = n++;
  });
  report.rows.reserve(last.size());
  n = 0;
  read_journals(corpus_folder(out), [&](JournalLine&& l) {
    const auto at = last.find(l.output);
    if (at == last.end() || at->second != n++) return;
    if (has_inputs && !is_there(l.input)) {
      ++report.removed;
      return;
    }
    ReportRow counts;
    count_messages(l, counts, report.kinds);
    const auto path = is_made(l.state) ? look_file(out, l) : "";
    auto row = row_of(std::move(l));
    row.errors = counts.errors;
    row.warnings = counts.warnings;
    row.lost = counts.lost;
    row.is_changed = has_inputs && is_made(row.state) && size_of_output(out, row) != row.output_bytes;
    if (!path.empty()) row.look = read_look(path);
    report.rows.push_back(std::move(row));
  });
  std::ranges::sort(report.rows, {}, &ReportRow::output);
  return report;
}

void compare(CorpusReport& report, const CorpusReport& before) {
  constexpr double much = 1.5, seconds_at_least = 0.2, size_at_least = 1.1, farther = 1.5;
  report.compared = before.out;
  const auto add = [&](const std::string& output, std::string what, bool worse) {
    report.changes.push_back({output, std::move(what), worse});
  };
  auto old = before.rows.begin();
  for (const auto& row : report.rows) {
    for (; old != before.rows.end() && old->output < row.output; ++old) add(old->output, "is no longer there", true);
    if (old == before.rows.end() || old->output != row.output) {
      add(row.output, fmt::format("is new: {}", to_string(row.state)), !is_made(row.state));
      continue;
    }
    const auto& was = *old++;
    if (row.state != was.state)
      add(row.output, fmt::format("{} instead of {}", to_string(row.state), to_string(was.state)),
          row.state > was.state);
    if (!is_made(row.state) || !is_made(was.state)) continue;
    if (row.errors != was.errors || row.lost != was.lost)
      add(row.output,
          fmt::format("errors {} instead of {}, lost {} instead of {}", row.errors, was.errors, row.lost, was.lost),
          row.errors > was.errors || row.lost > was.lost);
    const auto bytes = static_cast<double>(row.output_bytes), bytes_before = static_cast<double>(was.output_bytes);
    if (bytes > size_at_least * bytes_before || bytes_before > size_at_least * bytes)
      add(row.output, fmt::format("{} bytes instead of {}", row.output_bytes, was.output_bytes), bytes > bytes_before);
    else if (row.output_hash != was.output_hash)
      add(row.output, "other bytes", false);
    if (row.cpu > much * was.cpu + seconds_at_least)
      add(row.output, fmt::format("{:.2f} s of processor time instead of {:.2f}", row.cpu, was.cpu), true);
    if (row.look && was.look && row.look->rms > farther * was.look->rms + 1e-12)
      add(row.output, fmt::format("its surface is {:.3g} m rms away instead of {:.3g}", row.look->rms, was.look->rms),
          true);
  }
  for (; old != before.rows.end(); ++old) add(old->output, "is no longer there", true);
  std::stable_partition(report.changes.begin(), report.changes.end(), [](const Change& c) { return c.worse; });
}

std::string report_csv(const CorpusReport& report) {
  std::string out =
      "input,output,state,cause,seconds,cpu,memory,input_bytes,output_bytes,errors,warnings,lost,rms,max,of_diagonal\n";
  for (const auto& r : report.rows)
    out += fmt::format("{},{},{},{},{:.3f},{:.3f},{},{},{},{},{},{},{},{},{}\n", csv_text(r.input), csv_text(r.output),
                       to_string(r.state), csv_text(r.cause), r.seconds, r.cpu, r.memory, r.input_bytes, r.output_bytes,
                       r.errors, r.warnings, r.lost, number_or_nothing(r.look, &Look::rms),
                       number_or_nothing(r.look, &Look::max), number_or_nothing(r.look, &Look::of_diagonal));
  return out;
}

std::string report_json(const CorpusReport& report) { return json_of(report); }

}  // namespace wrlkit

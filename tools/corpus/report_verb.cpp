// wrlkit corpus report: the journals of a run as a page, a table or JSON. What has become of the scenes is measured and
// drawn by workers, as in the run: a scene that ends a worker has no picture, and the report has all others.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/image/image_codecs.h"
#include "base/text/amounts.h"
#include "tools/cli/cli.h"
#include "tools/cli/documents.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/progress.h"
#include "tools/cli/session.h"
#include "tools/corpus/conversion.h"
#include "tools/corpus/report.h"
#include "tools/corpus/workers.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr double most_seconds = 120;

/// Since the output was written.
bool is_looked_at(const std::string& out, const JournalLine& line) {
  std::error_code none;
  const auto look = look_file(out, line);
  return fs::exists(look, none) &&
         fs::last_write_time(look, none) >= fs::last_write_time(fs::path(out) / line.output, none);
}

/// Lines of what was made and has not been looked at, at most that many.
std::vector<JournalLine> to_be_looked_at(const std::string& out, std::size_t most) {
  std::map<std::string, JournalLine> last;
  read_journals(corpus_folder(out), [&](JournalLine&& l) {
    l.messages.clear();
    auto name = l.output;
    last[std::move(name)] = std::move(l);
  });
  std::vector<JournalLine> lines;
  std::size_t n = 0;
  for (auto& [name, l] : last) {
    if (!is_made(l.state) || !without_ending(l.output) || n == most) continue;
    ++n;
    if (!is_looked_at(out, l)) lines.push_back(std::move(l));
  }
  return lines;
}

void look(const Flags& flags, std::size_t most) {
  const auto& out = flags.inputs[0];
  const auto lines = to_be_looked_at(out, most);
  if (lines.empty()) return;
  std::string why;
  const auto recipe = read_recipe_options(run_recipe(out), why);
  Flags conversion = recipe ? conversion_flags(*recipe) : Flags{};
  auto& folders = conversion.load.allow_paths;
  folders.insert(folders.end(), flags.load.allow_paths.begin(), flags.load.allow_paths.end());
  std::error_code none;
  fs::create_directories(corpus_folder(out) + "/looks", none);
  load_image_codecs();
  const auto memory = flags.memory.empty() ? free_memory() / 10 * 8 : size_of(flags.memory);
  const std::size_t jobs =
      flags.jobs > 0 ? static_cast<std::size_t>(flags.jobs) : std::max(1u, std::thread::hardware_concurrency());
  Progress progress(!flags.quiet);
  progress.begin("looking", lines.size(), "worlds");
  Workers workers;
  for (std::size_t next = 0, ended = 0; ended < lines.size() && !Workers::interrupted();) {
    while (next < lines.size() && workers.running() < jobs) {
      const auto& line = lines[next];
      const bool begun = workers.start(next, memory / jobs, most_seconds,
                                       [&](const Workers::Tell&) { return make_look(conversion, out, line) ? 0 : 1; });
      if (!begun && !workers.running()) return;
      if (!begun) break;
      ++next;
    }
    if (workers.wait(1)) progress.set(++ended);
  }
}

/// A page there that is no report: the name was not chosen by the user, so it may be somebody's.
bool is_of_others(const std::string& path) {
  constexpr std::size_t most = 1024;
  std::ifstream page(path, std::ios::binary);
  std::string head(most, '\0');
  page.read(head.data(), most);
  head.resize(static_cast<std::size_t>(page.gcount()));
  return !head.empty() && head.find(": wrlkit</title>") == head.npos;
}

bool write(const CorpusReport& report, const std::string& path) {
  return write_text_file(path, path.ends_with(".csv")    ? report_csv(report)
                               : path.ends_with(".json") ? report_json(report) + '\n'
                                                         : report_page(report));
}

}  // namespace

int run_corpus_report(const Flags& flags) {
  const auto& out = flags.inputs[0];
  for (const auto& folder : {out, flags.compare})
    if (!folder.empty() && !fs::is_directory(corpus_folder(folder))) {
      complain("corpus report", fmt::format("there is no corpus run in '{}'", folder));
      return nothing;
    }
  if (flags.looks > 0) look(flags, static_cast<std::size_t>(flags.looks));
  auto report = read_report(out);
  if (!flags.compare.empty()) compare(report, read_report(flags.compare));
  if (report.removed > 0 && !flags.quiet)
    fmt::print(stderr, "{} {} no longer there and not counted\n", report.removed,
               report.removed == 1 ? "input is" : "inputs are");
  if (const auto n = report.n_changed(); n > 0) {
    const auto first = std::ranges::find(report.rows, true, &ReportRow::is_changed);
    complain("corpus report", fmt::format("{} gone, or of another size than a run made: '{}'{}",
                                          counted(n, "output") + (n == 1 ? " is" : " are"),
                                          (fs::path(out) / first->output).string(), n > 1 ? ", ..." : ""));
  }
  if (report.damaged > 0)
    complain("corpus report",
             fmt::format("{} of the journals cannot be read and {} not counted; run again to do those files",
                         counted(report.damaged, "line"), report.damaged == 1 ? "is" : "are"));
  if ((flags.json || !flags.report.empty()) && !give_document(flags, report_json(report))) return nothing;
  auto paths = flags.outputs;
  if (paths.empty() && !flags.json) {
    paths = {(fs::path(out) / "report.html").string()};
    if (is_of_others(paths[0])) {
      complain("corpus report", "'" + paths[0] + "' is not a report of wrlkit and stays; -o names another file");
      return usage;
    }
  }
  for (const auto& path : paths) {
    if (!write(report, path)) return nothing;
    if (!flags.quiet && path != "-") fmt::print(stderr, "{}\n", path);
  }
  return std::ranges::any_of(report.changes, &Change::worse) || report.n_changed() > 0 ? partly : done;
}

}  // namespace wrlkit

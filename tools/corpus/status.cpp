#include "tools/corpus/status.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <set>
#include <utility>

#include "base/diagnostics.h"
#include "base/text/json.h"
#include "base/text/json_reader.h"
#include "base/text/utf8.h"
#include "tools/cli/print_diagnostics.h"

namespace wrlkit {
namespace {

std::string time_text(double seconds) {
  const auto s = static_cast<long long>(seconds + 0.5);
  return s < 100    ? fmt::format("{} s", s)
         : s < 6000 ? fmt::format("{} min", (s + 30) / 60)
                    : fmt::format("{}:{:02} h", s / 3600, s % 3600 / 60);
}

/// Without what would move the cursor of a terminal or change its colours; what a worker printed keeps its lines.
std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto length = utf8_sequence(text);
    const bool shows = text[0] == '\n' || (length > 0 && static_cast<unsigned char>(text[0]) >= ' ' && text[0] != 0x7f);
    out += shows ? text.substr(0, length) : "?";
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

/// The width of the terminal, less the place of the cursor.
std::size_t width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : 79u;
}

/// Cuts to that many bytes, or a few less: the next character begins behind them.
void cut(std::string& line, std::size_t n) {
  if (line.size() <= n) return;
  while (n > 0 && (static_cast<unsigned char>(line[n]) & 0xc0) == 0x80) --n;
  line.resize(n);
}

}  // namespace

CorpusStatus::CorpusStatus(std::size_t files, double cost, bool quiet)
    : files_(files), cost_(cost), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

void CorpusStatus::add(JobState state, double cost, bool again) {
  ++done_;
  ++states_[static_cast<std::size_t>(state)];
  done_cost_ += cost;
  if (!again)
    cost_now_ += cost;
  else if (++before_; !is_made(state))
    ++failed_before_;
}

void CorpusStatus::failed(const std::string& input, const std::string& cause) {
  clear();
  const auto text = cause.starts_with(input + ":") ? cause : input + ": " + cause;
  fmt::print(stderr, "{}\n", printable(text));
}

void CorpusStatus::clear() {
  if (std::exchange(shown_, false) && terminal_) std::fputs("\r\033[K", stderr);
}

void CorpusStatus::show(const std::vector<std::string>& now) {
  const auto time = Clock::now();
  const double since = std::chrono::duration<double>(time - last_).count(),
               elapsed = std::chrono::duration<double>(time - start_).count();
  if (quiet_ || elapsed < 1 || since < (terminal_ ? 0.2 : 10.0)) return;
  last_ = time;
  clear();
  auto line = fmt::format("{}/{} files", done_, files_);
  if (before_) line += fmt::format(", {} of them before", before_);
  if (const auto lost = done_ - n_made()) line += fmt::format(", {} failed", lost);
  if (cost_now_ > 0)
    line += fmt::format(", {:.0f}/s, {} left", static_cast<double>(done_ - before_) / elapsed,
                        time_text(elapsed * (cost_ - done_cost_) / cost_now_));
  for (std::size_t i = 0; i < now.size() && i < 3; ++i) line += (i ? ", " : "; now ") + now[i];
  if (now.size() > 3) line += ", ...";
  if (terminal_) cut(line, width());  // what is on two lines cannot be overwritten
  fmt::print(stderr, "{}{}", line, terminal_ ? "" : "\n");
  std::fflush(stderr);
  shown_ = true;
}

CorpusStatus::~CorpusStatus() { clear(); }

void CorpusStatus::count_messages(const std::string& messages) {
  JsonDocument doc;
  if (doc.parse(messages)) return;
  std::set<std::string_view> errors;
  bool is_hidden = false;
  for (auto m : doc.root()) {
    if (m["severity"].text() == "error") errors.insert(m["name"].text());
    is_hidden |= m["name"].text() == info(Diag::hidden_geometry).name;
  }
  for (auto name : errors) ++errors_[std::string(name)];
  hidden_ += is_hidden;
}

void CorpusStatus::end(const std::string& out) {
  clear();
  fmt::print(stderr, "{}{}{}", quiet_ ? "" : summary(), quiet_ ? "" : hidden(), lacking(out));
  if (failed_before_ > 0)
    fmt::print(stderr, "failed in an earlier run: {}; 'wrlkit corpus report {}' lists them, --retry tries them again\n",
               counted(failed_before_, "file"), out);
}

std::string CorpusStatus::json() const {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("files", files_, "done", done_, "done_before", before_);
      for (const auto state : {JobState::made, JobState::made_partly, JobState::failed, JobState::crashed,
                               JobState::timeout, JobState::no_memory})
        json.member(to_string(state), n(state));
    });
  });
}

std::string CorpusStatus::lacking(const std::string& out) const {
  if (n(JobState::made_partly) == 0) return "";
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [name, files] : errors_) sorted.emplace_back(files, name);
  std::ranges::stable_sort(sorted, std::greater{}, &std::pair<std::size_t, std::string>::first);
  std::string list;
  for (const auto& [files, name] : sorted) list += fmt::format("{}{} in {}", list.empty() ? "" : ", ", name, files);
  return fmt::format("not complete: {}'wrlkit corpus report {}' lists them\n", list.empty() ? "" : list + "; ", out);
}

std::string CorpusStatus::hidden() const {
  if (hidden_ == 0) return "";
  return fmt::format(
      "hidden-geometry in {}: Switches that are off hide parts of them; `show-all = true` in [output] of "
      "the recipe shows these\n",
      counted(hidden_, "file"));
}

std::string CorpusStatus::summary() const {
  auto line = fmt::format("{} file{}: {} made", done_, done_ == 1 ? "" : "s", n_made());
  const auto part = [&](std::size_t n, std::string_view what) {
    if (n) line += fmt::format(", {} {}", n, what);
  };
  part(n(JobState::made_partly), "of them incomplete");
  part(n(JobState::failed), "failed");
  part(n(JobState::crashed), "crashed");
  part(n(JobState::timeout), "took too long");
  part(n(JobState::no_memory), "had not enough memory");
  part(before_, "had been done before");
  return line + fmt::format("; {}\n", time_text(std::chrono::duration<double>(Clock::now() - start_).count()));
}

}  // namespace wrlkit

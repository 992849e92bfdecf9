// wrlkit corpus run and corpus plan. One process plans, starts workers and writes the journal; each file is done by a worker
// (workers.h), which writes its output whole or not at all.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

#include <unistd.h>

#include "scenegraph/image_codecs.h"
#include "tools/cli.h"
#include "tools/corpus/conversion.h"
#include "tools/corpus/status.h"
#include "tools/corpus/workers.h"
#include "tools/session.h"
#include "writers/json.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "localhost";
}

/// As a shell reads it, on one line whatever is in it.
std::string shell_word(const std::string& word) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c >= 0x80 || std::string_view("/._-+:,=@%").find(static_cast<char>(c)) != std::string_view::npos; };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string out = "$'";
  for (const char c : word) {
    if (c == '\'' || c == '\\') out += '\\', out += c;
    else if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) out += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    else out += c;
  }
  return out + '\'';
}

/// "SIGABRT (Aborted)".
std::string signal_text(int signal) {
  const char* name = sigabbrev_np(signal);
  return fmt::format("{} ({})", name ? fmt::format("SIG{}", name) : fmt::format("signal {}", signal), strsignal(signal));
}

/// Whether the outputs would be written among the inputs.
bool is_input_folder(const CorpusPlan& plan, const std::string& out) {
  std::error_code none;
  const auto there = fs::weakly_canonical(out, none);
  return std::ranges::any_of(plan.roots, [&](const std::string& r) { return fs::weakly_canonical(r, none) == there; });
}

struct Planned {
  CorpusPlan plan;
  Shard shard;
};

std::optional<Planned> plan_of(const Flags& flags, bool assets) {
  std::string why;
  Planned p;
  const auto fail = [&] { return fmt::print(stderr, "wrlkit: {}\n", why), std::nullopt; };
  if (!flags.shard.empty()) {
    const auto shard = parse_shard(flags.shard, why);
    if (!shard) return fail();
    p.shard = *shard;
  }
  auto inputs = gather_inputs(flags.inputs, {.include = flags.include, .exclude = flags.exclude, .base = flags.base, .output = flags.output, .assets = assets}, why);
  if (!inputs) return fail();
  if (inputs->files.empty()) return why = "there are no worlds among the inputs", fail();
  auto plan = plan_corpus(std::move(*inputs), flags.format, p.shard.count, why);
  if (!plan) return fail();
  p.plan = std::move(*plan);
  if (is_input_folder(p.plan, flags.output)) return why = "'" + flags.output + "' is a folder of inputs; the outputs need one of their own", fail();
  return p;
}

class Run {
 public:
  Run(const Flags& flags, const CorpusWork& work, const Planned& planned, Journal journal)
      : flags_(flags), work_(work), plan_(planned.plan), journal_(std::move(journal)), before_(work, plan_), host_(host_name()) {
    for (std::uint32_t i = 0; i < plan_.jobs.size(); ++i)
      if (flags.shard.empty() || plan_.jobs[i].shard == planned.shard.index) todo_.push_back(i), cost_ += plan_.jobs[i].cost;
    memory_ = flags.memory.empty() ? free_memory() / 10 * 8 : size_of(flags.memory);
    jobs_ = flags.jobs > 0 ? static_cast<std::size_t>(flags.jobs) : std::max(1u, std::thread::hardware_concurrency());
    timeout_ = seconds_of(flags.timeout);
  }

  int run() {
    CorpusStatus status(todo_.size(), cost_, flags_.quiet);
    status_ = &status;
    if (!flags_.joblog.empty() && !open_joblog()) return usage;
    if (!flags_.quiet)
      for (const auto& [input, output] : plan_.kept) fmt::print(stderr, "{}: several inputs would become '{}'; this one keeps its ending in the name of the output\n", input, output);
    std::size_t next = 0;
    const auto start_some = [&] {
      while (next < todo_.size() && workers_.running() < jobs_) {
        const auto at = todo_[next];
        if (was_done(at)) { ++next; continue; }
        if (!start(at, share(at))) break;
        ++next;
      }
    };
    while (good_ && !Workers::interrupted() && (next < todo_.size() || workers_.running() || !alone_.empty())) {
      start_some();
      // Those that need all of the memory wait until everybody else is done.
      if (next == todo_.size() && !workers_.running() && !alone_.empty() && start(alone_.back(), memory_)) alone_.pop_back();
      if (workers_.running()) {
        if (auto end = workers_.wait(0.2)) {
          const auto memory = release(*end);
          start_some();  // before the journal has it, so that no core waits for that
          take(std::move(*end), memory);
        }
      }
      status.show(at_work());
    }
    if (!good_) return fmt::print(stderr, "wrlkit: the journal in '{}' cannot be written: {}\n", corpus_folder(work_.out), journal_fault_), nothing;
    journal_.settle();
    if (!flags_.quiet) fmt::print(stderr, "{}", status.summary());
    return status.n_made() == 0 && status.n_done() > 0 ? nothing : status.n(JobState::made) == status.n_done() ? done : partly;
  }

 private:
  /// What a job may have of the memory: its part, or what it is likely to need, but never more than there is.
  std::uint64_t share(std::uint32_t at) const { return std::min(memory_, std::max(memory_ / jobs_, 2 * plan_.jobs[at].memory)); }

  bool was_done(std::uint32_t at) {
    const auto& job = plan_.jobs[at];
    const auto state = before_.state_of(job);
    if (!state || (flags_.retry && !is_made(*state))) return false;
    status_->add(*state, job.cost, true);
    return true;
  }

  /// False when there is no room for it now.
  bool start(std::uint32_t at, std::uint64_t memory) {
    if (workers_.running() && granted_ + memory > memory_) return false;
    const auto& job = plan_.jobs[at];
    const bool begun = workers_.start(at, memory, timeout_, [&](std::string& result) {
      JournalLine line;
      const bool had_codecs = image_codecs_are_loaded();
      const int code = do_job(work_, plan_, job, line);
      line.codecs = !had_codecs && image_codecs_are_loaded();
      result = to_json(line);
      return code;
    });
    if (!begun) return std::this_thread::sleep_for(std::chrono::milliseconds(workers_.running() ? 0 : 100)), false;
    grants_[at] = memory;
    granted_ += memory;
    return true;
  }

  /// Takes the memory back that a worker had; how much that was.
  std::uint64_t release(const WorkerEnd& end) {
    const auto at = grants_.find(static_cast<std::uint32_t>(end.job));
    const auto memory = at->second;
    grants_.erase(at);
    granted_ -= memory;
    return memory;
  }

  void take(WorkerEnd end, std::uint64_t grant) {
    const auto at = static_cast<std::uint32_t>(end.job);
    const auto& job = plan_.jobs[at];
    const bool too_little = !end.timed_out && (end.exit_code == Workers::no_memory || end.signal == SIGKILL);
    if (too_little && grant < memory_) return alone_.push_back(at);
    auto line = line_of(job, end);
    // The codecs take longer to load than most files to convert: when they are wanted again and again, the workers to come have them.
    if (std::exchange(line.codecs, false) && ++with_codecs_ == few) load_image_codecs();
    if (!is_made(line.state)) {
      std::error_code none;
      if (before_.has(job)) fs::remove(fs::path(work_.out) / job.output, none);  // made by another recipe, or of what the input was
      status_->failed(line.input, line.cause);
    }
    if (!journal_.append(line)) good_ = false, journal_fault_ = std::strerror(errno);
    if (const auto now = std::chrono::steady_clock::now(); now - settled_ > std::chrono::seconds(5)) journal_.settle(), settled_ = now;
    log(line, end);
    status_->add(line.state, job.cost, false);
  }

  JournalLine line_of(const CorpusJob& job, const WorkerEnd& end) const {
    auto told = end.signal ? std::nullopt : journal_line(end.result);
    JournalLine line = told.value_or(JournalLine{});
    line.input = job.input.path, line.output = job.output, line.work = work_.hash, line.input_bytes = job.input.bytes;
    line.started = end.started, line.seconds = end.seconds, line.cpu = end.cpu, line.memory = end.memory;
    if (told) return line;
    line.input_hash = hash_of_file(job.input.path).value_or(ContentHash{});
    const auto printed = end.printed.empty() ? "" : ": " + end.printed.substr(0, end.printed.find_last_not_of('\n') + 1);
    if (end.timed_out) line.state = JobState::timeout, line.cause = fmt::format("it took longer than {}", flags_.timeout);
    else if (end.exit_code == Workers::no_memory) line.state = JobState::no_memory, line.cause = fmt::format("it needs more than {} of memory", readable_size(memory_));
    else if (end.signal) line.state = JobState::crashed, line.cause = fmt::format("the worker has ended by {}{}", signal_text(end.signal), printed);
    else line.state = JobState::crashed, line.cause = fmt::format("the worker has ended with exit code {}{}", end.exit_code, printed);
    return line;
  }

  bool open_joblog() {
    const bool is_new = !fs::exists(flags_.joblog);
    joblog_.open(flags_.joblog, std::ios::app);
    if (!joblog_) return fmt::print(stderr, "wrlkit: '{}' cannot be written\n", flags_.joblog), false;
    if (is_new) joblog_ << "Seq\tHost\tStarttime\tJobRuntime\tSend\tReceive\tExitval\tSignal\tCommand\n";
    return true;
  }

  void log(const JournalLine& l, const WorkerEnd& end) {
    if (!joblog_.is_open()) return;
    joblog_ << fmt::format("{}\t{}\t{:.3f}\t{:10.3f}\t{}\t{}\t{}\t{}\twrlkit convert {} {} --recipe {}\n", ++logged_, host_, l.started, l.seconds, l.input_bytes, l.output_bytes, end.exit_code, end.signal,
                           shell_word(l.input), shell_word((fs::path(work_.out) / l.output).string()), shell_word(flags_.recipe))
            << std::flush;
  }

  std::vector<std::string> at_work() const {
    std::vector<std::string> names;
    for (auto at : workers_.jobs()) names.push_back(plan_.jobs[at].input.inside);
    return names;
  }

  const Flags& flags_;
  const CorpusWork& work_;
  const CorpusPlan& plan_;
  Journal journal_;
  DoneBefore before_;
  std::string host_;
  std::vector<std::uint32_t> todo_, alone_;
  std::unordered_map<std::uint32_t, std::uint64_t> grants_;
  double cost_ = 0, timeout_ = 0;
  std::uint64_t memory_ = 0, granted_ = 0;
  static constexpr int few = 3;
  int with_codecs_ = 0;
  std::size_t jobs_ = 1, logged_ = 0;
  std::ofstream joblog_;
  std::chrono::steady_clock::time_point settled_ = std::chrono::steady_clock::now();
  CorpusStatus* status_ = nullptr;
  bool good_ = true;
  std::string journal_fault_;
  Workers workers_;
};

void print_plan(const Planned& p, const Flags& flags) {
  std::string json_text;
  JsonOut json(json_text);
  if (flags.json) json.begin_array();
  else fmt::print("shard\tseconds\tbytes\tinput\toutput\n");
  for (const auto& job : p.plan.jobs) {
    if (!flags.shard.empty() && job.shard != p.shard.index) continue;
    const auto output = (fs::path(flags.output) / job.output).string();
    if (!flags.json) {
      fmt::print("{}/{}\t{:.3f}\t{}\t{}\t{}\n", job.shard + 1, p.shard.count, job.cost, job.input.bytes, job.input.path, output);
      continue;
    }
    json.begin_object();
    json.member("shard", job.shard + 1);
    json.member("seconds", job.cost);
    json.member("bytes", job.input.bytes);
    json.member("input", job.input.path);
    json.member("output", output);
    json.end_object();
  }
  if (flags.json) json.end_array(), fmt::print("{}\n", json_text);
}

}  // namespace

int run_corpus_run(const Flags& flags) {
  std::string why;
  const auto work = corpus_work(flags, why);
  if (!work) return fmt::print(stderr, "{}", why), usage;
  const auto planned = plan_of(flags, work->text);
  if (!planned) return usage;
  auto journal = Journal::open(corpus_folder(flags.output), planned->shard, why);
  if (!journal) return fmt::print(stderr, "wrlkit: {}\n", why), usage;
  if (!write_run_recipe(*work, planned->plan)) return usage;
  return Run(flags, *work, *planned, std::move(*journal)).run();
}

int run_corpus_plan(const Flags& flags) {
  std::string why;
  const auto work = corpus_work(flags, why);
  if (!work) return fmt::print(stderr, "{}", why), usage;
  const auto planned = plan_of(flags, work->text);
  if (planned) print_plan(*planned, flags);
  return planned ? done : usage;
}

}  // namespace wrlkit

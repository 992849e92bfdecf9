// wrlkit corpus run. One process plans, starts workers and writes the journal; each file is done by a
// worker (workers.h), which writes its output whole or not at all.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unordered_set>
#include <utility>

#include <unistd.h>

#include "base/image/image_codecs.h"
#include "base/text/amounts.h"
#include "base/text/json.h"
#include "tools/cli/cli.h"
#include "tools/cli/documents.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/session.h"
#include "tools/corpus/planned.h"
#include "tools/corpus/shell_word.h"
#include "tools/corpus/status.h"
#include "tools/corpus/workers.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "localhost";
}

/// "SIGABRT (Aborted)".
std::string signal_text(int signal) {
  const char* name = sigabbrev_np(signal);
  return fmt::format("{} ({})", name ? fmt::format("SIG{}", name) : fmt::format("signal {}", signal),
                     strsignal(signal));
}

class Run {
 public:
  Run(const Flags& flags, const CorpusWork& work, const Planned& planned, DoneBefore before, Journal journal)
      : flags_(flags),
        work_(work),
        plan_(planned.plan),
        complete_(planned.left_out.empty()),
        journal_(std::move(journal)),
        before_(std::move(before)),
        host_(host_name()) {
    ours_ = planned.ours;
    for (const auto i : ours_) cost_ += plan_.jobs[i].cost;
    memory_ = flags.memory.empty() ? free_memory() / 10 * 8 : size_of(flags.memory);
    // What a pass in Python leaves behind in its process is for the next file to find.
    const int usual = work.flags.python.empty() ? 16 : 1;
    bundle_size_ = static_cast<std::size_t>(flags.bundle > 0 ? flags.bundle : usual);
    jobs_ = flags.jobs > 0 ? static_cast<std::size_t>(flags.jobs) : std::max(1u, std::thread::hardware_concurrency());
    timeout_ = seconds_of(flags.timeout);
  }

  int run() {
    CorpusStatus status(ours_.size(), cost_, flags_.quiet);
    status_ = &status;
    if (!flags_.joblog.empty() && !open_joblog()) return usage;
    if (!flags_.quiet)
      for (const auto& [input, output] : plan_.kept)
        fmt::print(stderr,
                   "{}: several inputs would become '{}'; this one keeps its ending in the name of the output\n", input,
                   output);
    while (good_ && !Workers::interrupted() &&
           (next_ < ours_.size() || !bundle_.empty() || workers_.running() || !alone_.empty())) {
      start_some();
      // Those that need all of the memory wait until everybody else is done.
      if (all_begun() && !workers_.running() && !alone_.empty() && start({alone_.back()}, memory_)) alone_.pop_back();
      if (workers_.running()) {
        if (auto end = workers_.wait(0.2)) {
          const auto work = release(*end);
          start_some();  // before the journal has it, so that no core waits for that
          take(*end, work);
        }
      }
      status.show(at_work());
    }
    if (!good_) {
      complain("corpus run",
               fmt::format("the journal in '{}' cannot be written: {}", corpus_folder(work_.out), journal_fault_));
      return nothing;
    }
    note_moved();
    journal_.settle();
    if (!Workers::interrupted()) status.end(work_.out);
    if (!give_document(flags_, status.json())) return nothing;
    if (status.n_made() == 0 && status.n_done() > 0) return nothing;
    return complete_ && status.n(JobState::made) == status.n_done() ? done : partly;
  }

 private:
  /// Files at work in one worker, and the memory that it has.
  struct Granted {
    std::vector<std::uint32_t> files;
    std::uint64_t memory = 0;
  };

  /// What files may have of the memory: their part, or what they are likely to need, but never more than there is.
  std::uint64_t share(const std::vector<std::uint32_t>& files) const {
    std::uint64_t likely = 0;
    for (const auto at : files) likely = std::max(likely, plan_.jobs[at].memory);
    return std::min(memory_, std::max(memory_ / jobs_, 2 * likely));
  }

  bool all_begun() const { return next_ == ours_.size() && bundle_.empty(); }
  /// Whether its worker may do others, too.
  bool may_share(std::uint32_t at) const {
    return bundle_size_ > 1 && plan_.jobs[at].cost < small_cost && !own_process_.contains(at);
  }

  /// Takes the next file that is not done, and small ones behind it, but leaves some to other workers.
  void fill_bundle() {
    const auto most = std::clamp<std::size_t>((ours_.size() - next_) / (2 * jobs_), 1, bundle_size_);
    while (next_ < ours_.size() && bundle_.size() < most) {
      const auto at = ours_[next_];
      if (!bundle_.empty() && !(may_share(bundle_.back()) && may_share(at))) return;
      ++next_;
      if (!was_done(at)) bundle_.push_back(at);
    }
  }

  void start_some() {
    while (workers_.running() < jobs_) {
      if (bundle_.empty()) fill_bundle();
      if (bundle_.empty() || !start(bundle_, share(bundle_))) return;
      bundle_.clear();
    }
  }

  bool was_done(std::uint32_t at) {
    const auto& job = plan_.jobs[at];
    const auto state = before_.state_of(job);
    const bool tries_again = flags_.retry || flags_.overwrite;  // a file of others may have been in the way
    if (!state || (tries_again && !is_made(*state))) return false;
    if (before_.is_moved(job)) moved_.emplace(job.output, job.input.path);
    status_->add(*state, job.cost, true);
    return true;
  }

  /// False when there is no room for them now.
  bool start(const std::vector<std::uint32_t>& files, std::uint64_t memory) {
    if (workers_.running() && granted_ + memory > memory_) return false;
    std::vector<bool> may_replace;
    for (const auto at : files) may_replace.push_back(flags_.overwrite || begin(at));
    // Whoever shares a worker and takes long is done again alone, with all of its time.
    const double timeout = files.size() == 1 ? timeout_ : std::min(timeout_, bundle_timeout);
    const bool begun = workers_.start(files.front(), memory, timeout, [&](const Workers::Tell& tell) {
      for (std::size_t i = 0; i < files.size(); ++i) tell(to_json(measured(files[i], may_replace[i])) + "\n");
      return done;
    });
    if (!begun) {
      for (std::size_t i = 0; i < files.size(); ++i)
        if (!may_replace[i]) begun_.erase(files[i]);
      std::this_thread::sleep_for(std::chrono::milliseconds(workers_.running() ? 0 : 100));
      return false;
    }
    grants_[files.front()] = {files, memory};
    granted_ += memory;
    return true;
  }

  /// Whether what lies where a file's outputs go is a run's own; from now on it is.
  bool begin(std::uint32_t at) {
    if (before_.owns(plan_.jobs[at]) || !begun_.insert(at).second) return true;
    if (!journal_.append_begun(plan_.jobs[at].output)) {
      good_ = false;
      journal_fault_ = std::strerror(errno);
    }
    return false;
  }

  /// In a worker: does a file.
  JournalLine measured(std::uint32_t at, bool may_replace) const {
    JournalLine line;
    const bool had_codecs = image_codecs_are_loaded();
    const ProcessUsage before;
    do_job(work_, plan_, plan_.jobs[at], may_replace, line);
    const ProcessUsage after;
    line.codecs = !had_codecs && image_codecs_are_loaded();
    line.started = before.time;
    line.seconds = after.time - before.time;
    line.cpu = after.cpu - before.cpu;
    line.memory = after.memory;
    return line;
  }

  /// Takes the memory back that a worker had.
  Granted release(const WorkerEnd& end) {
    const auto at = grants_.find(static_cast<std::uint32_t>(end.job));
    auto work = std::move(at->second);
    grants_.erase(at);
    granted_ -= work.memory;
    return work;
  }

  void take(const WorkerEnd& end, const Granted& work) {
    std::string_view told = end.told;
    const bool alone = work.files.size() == 1;
    for (const auto at : work.files) {
      const auto length = told.find('\n');
      auto line = length == told.npos ? std::nullopt : journal_line(told.substr(0, length));
      if (line) {
        told.remove_prefix(length + 1);
        if (alone) measure(*line, end);
        take(at, std::move(*line));
      } else if (!alone) {  // whichever of them has ended the worker: the next one will say
        own_process_.insert(at);
        ours_.push_back(at);
      } else if (!end.timed_out && (end.exit_code == Workers::no_memory || end.signal == SIGKILL) &&
                 work.memory < memory_) {
        alone_.push_back(at);
      } else {
        auto failed = failure(at, end);
        measure(failed, end);
        take(at, std::move(failed), end.exit_code, end.signal);
      }
    }
  }

  void take(std::uint32_t at, JournalLine line, int exit_code = 0, int signal = 0) {
    const auto& job = plan_.jobs[at];
    line.input = job.input.path;
    line.output = job.output;
    line.work = work_.hash;
    line.input_bytes = job.input.bytes;
    // The codecs take longer to load than most files to convert: when they are wanted again and again, the workers to
    // come have them.
    if (std::exchange(line.codecs, false) && ++with_codecs_ == few) load_image_codecs();
    if (!is_made(line.state)) {
      std::error_code none;
      if (before_.has_begun(job) && fs::exists(fs::path(work_.out) / job.output, none))
        line.cause += "; what was there before is untouched";
      status_->failed(line.input, line.cause);
    }
    if (!journal_.append(line)) {
      good_ = false;
      journal_fault_ = std::strerror(errno);
    }
    if (const auto now = std::chrono::steady_clock::now(); now - settled_ > std::chrono::seconds(5)) {
      journal_.settle();
      settled_ = now;
    }
    const int code = line.state == JobState::made          ? done
                     : line.state == JobState::made_partly ? partly
                     : line.state == JobState::failed      ? nothing
                                                           : exit_code;
    if (is_made(line.state)) status_->count_messages(line.messages);
    log(line, code, signal);
    status_->add(line.state, job.cost, false);
  }

  /// Inputs that have other names now: what was known of them is written down once more.
  void note_moved() {
    if (moved_.empty()) return;
    std::unordered_map<std::string, JournalLine> last;
    read_journals(corpus_folder(work_.out), [&](JournalLine&& line) {
      if (moved_.contains(line.output)) last.insert_or_assign(line.output, std::move(line));
    });
    for (auto& [output, line] : last) {
      line.input = moved_.at(output);
      if (!journal_.append(line)) return;
    }
  }

  static void measure(JournalLine& line, const WorkerEnd& end) {
    line.started = end.started;
    line.seconds = end.seconds;
    line.cpu = end.cpu;
    line.memory = end.memory;
  }

  /// The line for a worker that could not write it itself.
  JournalLine failure(std::uint32_t at, const WorkerEnd& end) const {
    JournalLine line;
    line.input_hash = hash_of_file(plan_.jobs[at].input.path).value_or(ContentHash{});
    const auto printed =
        end.printed.empty() ? "" : ": " + end.printed.substr(0, end.printed.find_last_not_of('\n') + 1);
    if (end.timed_out) {
      line.state = JobState::timeout;
      line.cause = fmt::format("it took longer than {}", flags_.timeout);
    } else if (end.exit_code == Workers::no_memory) {
      line.state = JobState::no_memory;
      line.cause = fmt::format("it needs more than {} of memory", readable_size(memory_));
    } else if (end.signal) {
      line.state = JobState::crashed;
      line.cause = fmt::format("the worker has ended by {}{}", signal_text(end.signal), printed);
    } else {
      line.state = JobState::crashed;
      line.cause = fmt::format("the worker has ended with exit code {}{}", end.exit_code, printed);
    }
    return line;
  }

  bool open_joblog() {
    constexpr std::string_view heading = "Seq\tHost\tStarttime\tJobRuntime\tSend\tReceive\tExitval\tSignal\tCommand";
    std::string first;
    const bool is_new = !std::getline(std::ifstream(flags_.joblog), first);
    if (!is_new && first != heading) {
      complain("corpus run", "--joblog: '" + flags_.joblog + "' is not a job log; choose another name");
      return false;
    }
    joblog_.open(flags_.joblog, std::ios::app);
    if (!joblog_) {
      fmt::print(stderr, "wrlkit: '{}' cannot be written\n", flags_.joblog);
      return false;
    }
    if (is_new) joblog_ << heading << '\n';
    return true;
  }

  void log(const JournalLine& l, int exit_code, int signal) {
    if (!joblog_.is_open()) return;
    joblog_ << fmt::format("{}\t{}\t{:.3f}\t{:10.3f}\t{}\t{}\t{}\t{}\twrlkit convert {} {} --recipe {}\n", ++logged_,
                           host_, l.started, l.seconds, l.input_bytes, l.output_bytes, exit_code, signal,
                           shell_word(l.input), shell_word((fs::path(work_.out) / l.output).string()),
                           shell_word(flags_.recipe))
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
  bool complete_;  // nothing of the inputs was left out
  Journal journal_;
  DoneBefore before_;
  std::string host_;
  std::vector<std::uint32_t> ours_, bundle_, alone_;  // bundle_: taken from ours_, not begun
  std::unordered_set<std::uint32_t> own_process_;
  std::unordered_set<std::uint32_t> begun_;  // of those that no run had begun before
  std::unordered_map<std::string, std::string>
      moved_;  // outputs that had been done, and what their inputs are called now
  std::unordered_map<std::uint32_t, Granted> grants_;  // by the first file
  std::size_t next_ = 0, bundle_size_ = 1;
  double cost_ = 0, timeout_ = 0;
  std::uint64_t memory_ = 0, granted_ = 0;
  static constexpr int few = 3;
  static constexpr double bundle_timeout = 30;  // seconds
  static constexpr double small_cost = 0.005;   // a process costs more than a tenth of that
  int with_codecs_ = 0;
  std::size_t jobs_ = 1, logged_ = 0;
  std::ofstream joblog_;
  std::chrono::steady_clock::time_point settled_ = std::chrono::steady_clock::now();
  CorpusStatus* status_ = nullptr;
  bool good_ = true;
  std::string journal_fault_;
  Workers workers_;
};

}  // namespace

int run_corpus_run(const Flags& flags) {
  std::string why;
  const auto work = asked_work(flags);
  if (!work) return usage;
  int code = usage;
  const auto planned = plan_of("corpus run", flags, work->text, code);
  if (!planned) return code;
  // First what is there: another run writes down what it begins before anything is there.
  auto in_the_way = existing_outputs(*planned, flags.output);
  std::error_code none;
  const bool is_first = !fs::exists(corpus_folder(flags.output), none);
  if (is_first && is_refused(in_the_way, *planned, flags)) return usage;
  auto journal = Journal::open(corpus_folder(flags.output), planned->shard, why);
  if (!journal) {
    complain("corpus run", why);
    return nothing;
  }
  DoneBefore before(*work, planned->plan);
  std::erase_if(in_the_way, [&](std::uint32_t at) { return before.has_begun(planned->plan.jobs[at]); });
  if (is_refused(in_the_way, *planned, flags)) return usage;
  if (!write_run_recipe(*work, planned->plan)) return usage;
  return Run(flags, *work, *planned, std::move(before), std::move(*journal)).run();
}

}  // namespace wrlkit

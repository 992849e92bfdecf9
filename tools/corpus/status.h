// How far a corpus run is: a line that is overwritten on a terminal, a line every ten seconds in a log. What fails is
// printed at once.
#pragma once
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "tools/corpus/journal.h"

namespace wrlkit {

class CorpusStatus {
 public:
  /// For that many files, which cost that much; `quiet`: only failures are printed.
  CorpusStatus(std::size_t files, double cost, bool quiet);
  ~CorpusStatus();
  CorpusStatus(const CorpusStatus&) = delete;

  void add(JobState state, double cost, bool again);
  void failed(const std::string& input, const std::string& cause);
  /// Says how far it is when it is time to.
  void show(const std::vector<std::string>& now);
  /// Counts what is said of a file that was made; JSON, as --report has it.
  void count_messages(const std::string& messages);
  /// The last lines: what became of all files, and what the outputs lack.
  void end(const std::string& out);
  /// The same counts: files, those of earlier runs, and how many came to each end.
  std::string json() const;

  std::size_t n(JobState s) const { return states_[static_cast<std::size_t>(s)]; }
  std::size_t n_made() const { return n(JobState::made) + n(JobState::made_partly); }
  std::size_t n_done() const { return done_; }

 private:
  using Clock = std::chrono::steady_clock;
  void clear();
  std::string summary() const;
  std::string lacking(const std::string& out) const;
  std::string hidden() const;

  std::size_t files_, done_ = 0, before_ = 0, failed_before_ = 0, states_[6] = {};
  std::map<std::string, std::size_t> errors_;   // files, by the name of the message
  std::size_t hidden_ = 0;                      // files of which Switches hide much
  double cost_, done_cost_ = 0, cost_now_ = 0;  // now: without what was done before
  bool quiet_, terminal_, shown_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace wrlkit

// Processes that do their work and are gone: what one of them does to itself it does to no other. They are forks of
// this process, so that nothing has to be loaded or read again; this process must have a single thread.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

/// What a worker leaves behind.
struct WorkerEnd {
  std::size_t job = 0;
  int exit_code = 0;  // unless a signal has ended it
  int signal = 0;
  bool timed_out = false;
  double started = 0, seconds = 0, cpu = 0;  // Unix time; wall clock; processor
  std::uint64_t memory = 0;                  // most at a time, bytes
  std::string told;                          // what it reported of its work, as far as it got
  std::string printed;                       // the end of what it printed
};

class Workers {
 public:
  /// Takes a report about the work, at once: it is kept however the worker ends.
  using Tell = std::function<void(std::string_view)>;
  /// Gives an exit code.
  using Work = std::function<int(const Tell& tell)>;
  /// The exit code of a worker that has run out of memory and knows it.
  static constexpr int no_memory = 100;

  /// From now on SIGHUP, SIGINT and SIGTERM wait for the end of this object.
  Workers();
  /// Those still at work are ended, with all that they have started; then this process, if it was interrupted.
  ~Workers();
  Workers(const Workers&) = delete;

  std::size_t running() const { return running_.size(); }
  /// Jobs at work, in the order in which they were begun.
  std::vector<std::size_t> jobs() const;
  /// Begins a job, with `memory` bytes beyond what this process has and that many seconds. False when the system has no
  /// more processes.
  bool start(std::size_t job, std::uint64_t memory, double timeout, const Work& work);
  /// Whether a signal is to end this process.
  static bool interrupted();
  /// The next that ends, or nothing after that many seconds or when this process is interrupted.
  std::optional<WorkerEnd> wait(double seconds);

 private:
  struct Worker {
    std::size_t job;
    pid_t pid;
    int told, printed;  // pipes
    double started, began, deadline;
    bool timed_out = false;
    WorkerEnd end;
  };
  void read_some(Worker&);
  WorkerEnd finish(Worker&);
  std::vector<Worker> running_;
};

/// What this process has used up to now.
struct ProcessUsage {
  ProcessUsage();
  double time, cpu;      // Unix time; processor seconds
  std::uint64_t memory;  // most at a time, bytes
};

/// To be called around a fork, by a language that runs in this process as well.
struct ForkHooks {
  void (*before)() = [] {};
  void (*parent)() = [] {};
  void (*child)() = [] {};
};
inline ForkHooks fork_hooks;

/// What the system says is free for programs now, in bytes, or what a control group leaves of it.
std::uint64_t free_memory();

}  // namespace wrlkit

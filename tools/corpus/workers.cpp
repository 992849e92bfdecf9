#include "tools/corpus/workers.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <new>
#include <utility>

namespace wrlkit {
namespace {

constexpr std::size_t most_printed = 4096;
constexpr int ending_signals[] = {SIGHUP, SIGINT, SIGTERM};
volatile std::sig_atomic_t ending = 0;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
double clock_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::uint64_t address_space() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t pages = 0;
  statm >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const auto n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno != EINTR) return;
    if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
  }
}

void limit(int what, std::uint64_t value) {
  const rlimit l{value, value};
  setrlimit(static_cast<__rlimit_resource>(what), &l);
}

/// In the child: never returns.
[[noreturn]] void work_and_exit(pid_t parent, std::uint64_t memory, int told_fd, int printed_fd,
                                const Workers::Work& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);
  setpgid(0, 0);  // with what it starts itself
  for (const int s : ending_signals) signal(s, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(printed_fd, STDOUT_FILENO);
  dup2(printed_fd, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, address_space() + memory);
  int code = Workers::no_memory;
  try {
    code = work([&](std::string_view text) { write_all(told_fd, text); });
  } catch (const std::bad_alloc&) {
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    code = 3;
  }
  std::fflush(stdout);
  std::fflush(stderr);
  _exit(code);  // what is not written yet is not to be written; the memory goes all at once
}

double cpu_of(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t memory_of(const rusage& usage) { return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024; }

bool make_pipe(int (&ends)[2]) { return pipe2(ends, O_CLOEXEC) == 0; }

}  // namespace

Workers::Workers() {
  ending = 0;
  for (const int s : ending_signals)
    if (signal(s, [](int which) { ending = which; }) == SIG_IGN) signal(s, SIG_IGN);  // of nohup
}

bool Workers::interrupted() { return ending != 0; }

Workers::~Workers() {
  for (auto& w : running_) kill(w.pid, SIGKILL);
  for (auto& w : running_) finish(w);
  for (const int s : ending_signals)
    if (signal(s, SIG_DFL) == SIG_IGN) signal(s, SIG_IGN);
  if (ending) raise(ending);
}

std::vector<std::size_t> Workers::jobs() const {
  std::vector<std::size_t> out;
  for (const auto& w : running_) out.push_back(w.job);
  return out;
}

bool Workers::start(std::size_t job, std::uint64_t memory, double timeout, const Work& work) {
  int told[2], printed[2];
  if (!make_pipe(told)) return false;
  if (!make_pipe(printed)) {
    close(told[0]);
    close(told[1]);
    return false;
  }
  std::fflush(nullptr);  // or the child would print it, too
  const pid_t self = getpid();
  fork_hooks.before();
  const pid_t pid = fork();
  if (pid == 0) {
    fork_hooks.child();
    work_and_exit(self, memory, told[1], printed[1], work);
  }
  fork_hooks.parent();
  close(told[1]);
  close(printed[1]);
  if (pid < 0) {
    close(told[0]);
    close(printed[0]);
    return false;
  }
  for (int fd : {told[0], printed[0]}) fcntl(fd, F_SETFL, O_NONBLOCK);
  running_.push_back({job, pid, told[0], printed[0], clock_time(), now(), now() + timeout, false, {}});
  return true;
}

void Workers::read_some(Worker& w) {
  char piece[65536];
  for (auto [fd, text] : {std::pair(&w.told, &w.end.told), std::pair(&w.printed, &w.end.printed)}) {
    while (*fd >= 0) {
      const auto n = read(*fd, piece, sizeof piece);
      if (n > 0)
        text->append(piece, static_cast<std::size_t>(n));
      else if (n == 0)
        close(std::exchange(*fd, -1));
      else if (errno != EINTR)
        break;
    }
  }
  if (w.end.printed.size() > 2 * most_printed) w.end.printed.erase(0, w.end.printed.size() - most_printed);
}

WorkerEnd Workers::finish(Worker& w) {
  int status = 0;
  rusage usage{};
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(w.pid), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
  }
  kill(-w.pid, SIGKILL);  // while the worker's number is still its own
  while (wait4(w.pid, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  for (int fd : {w.told, w.printed})
    if (fd >= 0) close(fd);
  auto& e = w.end;
  e.job = w.job;
  e.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  e.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  e.timed_out = w.timed_out;
  e.started = w.started;
  e.seconds = now() - w.began;
  e.cpu = cpu_of(usage);
  e.memory = memory_of(usage);
  if (e.printed.size() > most_printed) e.printed.erase(0, e.printed.size() - most_printed);
  return std::move(e);
}

std::optional<WorkerEnd> Workers::wait(double seconds) {
  const double until = now() + seconds;
  for (;;) {
    double next = until;
    std::vector<pollfd> fds;
    for (auto& w : running_) {
      if (!w.timed_out && now() >= w.deadline) {
        kill(w.pid, SIGKILL);
        w.timed_out = true;
      }
      if (!w.timed_out) next = std::min(next, w.deadline);
      fds.push_back({w.told, POLLIN, 0});
      fds.push_back({w.printed, POLLIN, 0});
    }
    const int ms = static_cast<int>(std::clamp((next - now()) * 1000 + 1, 0.0, 60'000.0));
    if (poll(fds.data(), fds.size(), ms) < 0 && errno != EINTR) return std::nullopt;
    for (std::size_t i = 0; i < running_.size(); ++i) {
      auto& w = running_[i];
      read_some(w);
      if (w.told >= 0) continue;  // what a worker has started itself may hold the other pipe longer
      auto end = finish(w);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      return end;
    }
    if (now() >= until || interrupted()) return std::nullopt;
  }
}

ProcessUsage::ProcessUsage() : time(clock_time()) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  cpu = cpu_of(usage);
  memory = memory_of(usage);
}

std::uint64_t free_memory() {
  std::uint64_t free = 1 << 30;
  std::ifstream info("/proc/meminfo");
  for (std::string name, rest; info >> name;) {
    std::uint64_t kilobytes = 0;
    if (name == "MemAvailable:" && info >> kilobytes) free = kilobytes * 1024;
    std::getline(info, rest);
  }
  std::ifstream group("/sys/fs/cgroup/memory.max"), used_by_group("/sys/fs/cgroup/memory.current");
  std::uint64_t most = 0, used = 0;
  if (group >> most && used_by_group >> used) free = std::min(free, most > used ? most - used : 0);
  return free;
}

}  // namespace wrlkit

#include "passes/startup/host.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/io/own_files.h"
#include "passes/startup/limits.h"

namespace wrlkit {
namespace {

constexpr int out_of_memory = 71;  // exit code of the process

std::string too_long() { return "more than " + std::to_string(script_seconds) + " s of processor time"; }
std::string too_large() { return "more than " + std::to_string(script_memory >> 20) + " MiB of memory"; }

}  // namespace

std::string script_host_path() {
  const auto paths = own_files("wrlkit_script", "WRLKIT_SCRIPT");
  return paths.empty() ? std::string() : paths.front().string();
}

ScriptHost::~ScriptHost() {
  if (pid_ > 0) kill(pid_, SIGKILL);
  reap();
}

bool ScriptHost::start(const std::string& path) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return end(std::strerror(errno));
  socket_ = ends[0];
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, defaults;
  sigemptyset(&none);
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGXCPU);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::string name = path, zone = "TZ=UTC0", locale = "LC_ALL=C";
  char* arguments[] = {name.data(), nullptr};
  char* environment[] = {zone.data(), locale.data(), nullptr};
  const int fault = posix_spawn(&pid_, path.c_str(), &actions, &attributes, arguments, environment);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (fault != 0) {
    pid_ = -1;
    return end(path + ": " + std::strerror(fault));
  }
  until_ = std::chrono::steady_clock::now() + std::chrono::seconds(script_wait_seconds);
  return true;
}

bool ScriptHost::run(FrameKind kind, std::uint32_t script, std::string_view first, std::string_view second,
                     std::string& result) {
  if (!fault_.empty() || !send(kind, script, first, second)) return false;
  FrameHead head;
  while (receive(head, result)) {
    if (head.kind == FrameKind::result) return true;
    if (++requests_ > script_requests) return end("more than " + std::to_string(script_requests) + " requests");
    if (!send(FrameKind::answer, script, answer_(result), {})) return false;
  }
  return false;
}

void ScriptHost::drop(std::uint32_t script) {
  if (fault_.empty()) send(FrameKind::drop, script, {}, {});
}

bool ScriptHost::send(FrameKind kind, std::uint32_t script, std::string_view first, std::string_view second) {
  const std::size_t bytes = first.size() + second.size();
  exchanged_ += bytes;
  if (bytes > most_frame_bytes || exchanged_ > script_exchanged) return end(too_large());
  FrameHead head{.kind = kind,
                 .script = script,
                 .bytes = static_cast<std::uint32_t>(bytes),
                 .first = static_cast<std::uint32_t>(first.size())};
  std::string frame(reinterpret_cast<const char*>(&head), sizeof head);
  frame += first;
  frame += second;
  return transfer(frame.data(), frame.size(), true);
}

bool ScriptHost::receive(FrameHead& head, std::string& bytes) {
  if (!transfer(reinterpret_cast<char*>(&head), sizeof head, false)) return false;
  exchanged_ += head.bytes;
  if (head.bytes > most_frame_bytes || exchanged_ > script_exchanged) return end(too_large());
  bytes.resize(head.bytes);
  return transfer(bytes.data(), bytes.size(), false);
}

bool ScriptHost::transfer(char* at, std::size_t n, bool out) {
  while (n > 0) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until_ - std::chrono::steady_clock::now()).count();
    pollfd ready{socket_, static_cast<short>(out ? POLLOUT : POLLIN), 0};
    const int polled = left > 0 ? poll(&ready, 1, static_cast<int>(left)) : 0;
    if (polled < 0 && errno == EINTR) continue;
    if (polled <= 0) return end("more than " + std::to_string(script_wait_seconds) + " s");
    const auto moved = out ? ::send(socket_, at, n, MSG_NOSIGNAL | MSG_DONTWAIT) : recv(socket_, at, n, MSG_DONTWAIT);
    if (moved < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (moved <= 0) return ended();
    at += moved;
    n -= static_cast<std::size_t>(moved);
  }
  return true;
}

bool ScriptHost::end(std::string why) {
  fault_ = std::move(why);
  if (pid_ > 0) kill(pid_, SIGKILL);
  reap();
  return false;
}

bool ScriptHost::ended() {
  fault_ = reap();
  return false;
}

/// Waits for the end, which has come or was ordered, and says why it came.
std::string ScriptHost::reap() {
  if (socket_ >= 0) close(socket_);
  socket_ = -1;
  if (pid_ <= 0) return "the process is not there";
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) return too_long();
  if (WIFSIGNALED(status)) return std::string("the process ended by signal ") + strsignal(WTERMSIG(status));
  if (WEXITSTATUS(status) == out_of_memory) return too_large();
  return "the process ended with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace wrlkit

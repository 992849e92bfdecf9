// The process in which Scripts run: wrlkit_script, which is built where Duktape is there (tools/script_host). Started
// by posix_spawn, which is safe in a program with threads; ended with this object.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "passes/startup/frames.h"

namespace wrlkit {

/// Where wrlkit_script is; empty: it is not installed.
std::string script_host_path();

class ScriptHost {
 public:
  /// Answers what a Script asks; both are JSON.
  using Answer = std::function<std::string(std::string_view request)>;

  explicit ScriptHost(Answer answer) : answer_(std::move(answer)) {}
  ~ScriptHost();
  ScriptHost(const ScriptHost&) = delete;
  ScriptHost& operator=(const ScriptHost&) = delete;

  /// False when it cannot be started: `fault` says why.
  bool start(const std::string& path);
  /// Sends a frame and answers what is asked until the result is there. False when the process has ended, or was ended
  /// since it went over a limit; nothing runs from then on.
  bool run(FrameKind kind, std::uint32_t script, std::string_view first, std::string_view second, std::string& result);
  void drop(std::uint32_t script);
  /// Ends it for that reason; false.
  bool end(std::string why);
  /// Why nothing runs any more: "more than 2 s of processor time".
  const std::string& fault() const { return fault_; }

 private:
  bool send(FrameKind, std::uint32_t script, std::string_view first, std::string_view second);
  bool receive(FrameHead&, std::string&);
  bool transfer(char* at, std::size_t n, bool out);
  bool ended();
  std::string reap();

  Answer answer_;
  std::string fault_;
  pid_t pid_ = -1;
  int socket_ = -1;
  std::chrono::steady_clock::time_point until_;
  std::size_t requests_ = 0, exchanged_ = 0;
};

}  // namespace wrlkit

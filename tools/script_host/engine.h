// The engine of ECMAScript: Duktape, behind this header. It has no way to a file, a network or another process; what a
// program asks for goes to a function of the caller. Memory beyond a limit is an error that the program gets.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace wrlkit {

class ScriptEngine {
 public:
  /// Exit code of the process when memory is not enough for the engine itself.
  static constexpr int out_of_memory = 71;
  /// Answers a request, both as JSON (annex_c.js).
  using Ask = std::function<std::string(std::string_view request)>;

  ScriptEngine(std::size_t most_memory, Ask ask);
  ~ScriptEngine();
  ScriptEngine(const ScriptEngine&) = delete;
  ScriptEngine& operator=(const ScriptEngine&) = delete;

  /// Makes an environment with these fields (JSON) and runs the text in it, which defines its functions. What goes
  /// wrong is returned; empty: nothing.
  std::string load(std::uint32_t id, std::string_view fields, std::string_view text);
  /// Calls a function of an environment; all as JSON: the call, and the events that it sent.
  std::string call(std::uint32_t id, std::string_view call);
  void drop(std::uint32_t id);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wrlkit

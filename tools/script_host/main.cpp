// wrlkit_script: the process in which Scripts of worlds run (pass `startup`). It reads frames from standard input,
// which is a socket, and writes frames to it. Before it reads the first one it gives up all that a hostile program
// could use: files, memory, time, further processes and every system call but those that it needs.
#include <unistd.h>

#include <cstddef>
#include <string>

#include "passes/startup/frames.h"
#include "passes/startup/limits.h"
#include "tools/script_host/engine.h"
#include "tools/script_host/sandbox.h"

namespace wrlkit {
namespace {

constexpr int socket_fd = 0;

void read_all(void* to, std::size_t n) {
  auto* at = static_cast<char*>(to);
  while (n > 0) {
    const auto got = read(socket_fd, at, n);
    if (got <= 0) _exit(0);  // wrlkit has gone
    at += got;
    n -= static_cast<std::size_t>(got);
  }
}

void write_all(const void* from, std::size_t n) {
  const auto* at = static_cast<const char*>(from);
  while (n > 0) {
    const auto put = write(socket_fd, at, n);
    if (put <= 0) _exit(0);
    at += put;
    n -= static_cast<std::size_t>(put);
  }
}

void send(FrameKind kind, std::string_view bytes) {
  if (bytes.size() > most_frame_bytes) _exit(ScriptEngine::out_of_memory);
  const FrameHead head{.kind = kind, .bytes = static_cast<std::uint32_t>(bytes.size())};
  write_all(&head, sizeof head);
  write_all(bytes.data(), bytes.size());
}

std::string receive(FrameHead& head) {
  read_all(&head, sizeof head);
  if (head.bytes > most_frame_bytes) _exit(0);
  std::string bytes(head.bytes, '\0');
  read_all(bytes.data(), bytes.size());
  return bytes;
}

[[noreturn]] void run() {
  ScriptEngine engine(script_memory, [](std::string_view request) {
    send(FrameKind::ask, request);
    FrameHead head;
    return receive(head);
  });
  for (;;) {
    FrameHead head;
    const std::string bytes = receive(head);
    const std::string_view all = bytes;
    if (head.kind == FrameKind::drop)
      engine.drop(head.script);
    else if (head.kind == FrameKind::call)
      send(FrameKind::result, engine.call(head.script, all));
    else if (head.first <= all.size())
      send(FrameKind::result, engine.load(head.script, all.substr(0, head.first), all.substr(head.first)));
  }
}

}  // namespace
}  // namespace wrlkit

int main() {
  if (!wrlkit::enter_sandbox()) return 1;
  wrlkit::run();
}

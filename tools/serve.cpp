#include "tools/serve.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

namespace wrlkit {
namespace {

class Socket {
 public:
  explicit Socket(int fd) : fd_(fd) {}
  ~Socket() {
    if (fd_ >= 0) ::close(fd_);
  }
  Socket(const Socket&) = delete;
  operator int() const { return fd_; }

 private:
  int fd_;
};

void send_all(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto n = ::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

/// The head of a request, as far as it comes in one second and is no longer than it should be.
std::string head_of_request(int from) {
  const timeval patience{1, 0};
  setsockopt(from, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  constexpr std::size_t most = 16 * 1024;
  std::string head;
  char piece[2048];
  while (head.size() < most && head.find("\r\n\r\n") == head.npos) {
    const auto n = ::recv(from, piece, sizeof piece, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    head.append(piece, static_cast<std::size_t>(n));
  }
  return head;
}

/// Only what asks for this address by its number or as localhost: a page of another site may give its name to 127.0.0.1.
bool is_meant(std::string_view head, std::uint16_t port) {
  return head.find(fmt::format("\r\nHost: 127.0.0.1:{}\r\n", port)) != head.npos ||
         head.find(fmt::format("\r\nHost: localhost:{}\r\n", port)) != head.npos;
}

void answer(int to, std::uint16_t port, std::string_view html) {
  const auto head = head_of_request(to);
  const bool known = is_meant(head, port) && (head.starts_with("GET / ") || head.starts_with("HEAD / "));
  const auto body = known ? html : std::string_view("not found\n");
  send_all(to, fmt::format("HTTP/1.1 {}\r\nContent-Type: {}; charset=utf-8\r\nContent-Length: {}\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n",
                           known ? "200 OK" : "404 Not Found", known ? "text/html" : "text/plain", body.size()));
  if (!head.starts_with("HEAD ")) send_all(to, body);
}

std::string reason() { return std::generic_category().message(errno); }

}  // namespace

std::string serve_page(std::string_view html) {
  const Socket listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  auto* address = reinterpret_cast<sockaddr*>(&here);
  if (listener < 0 || ::bind(listener, address, size) != 0 || ::listen(listener, 8) != 0 || ::getsockname(listener, address, &size) != 0) return reason();
  const auto port = ntohs(here.sin_port);
  fmt::print("http://127.0.0.1:{}/\n", port);
  std::fflush(stdout);
  for (;;) {
    const Socket client(::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC));
    if (client >= 0) answer(client, port, html);
    else if (errno != EINTR && errno != ECONNABORTED) return reason();
  }
}

}  // namespace wrlkit

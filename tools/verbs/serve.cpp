#include "tools/verbs/serve.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <semaphore>
#include <system_error>
#include <thread>

#include "base/text/letter_case.h"

namespace wrlkit {
namespace {

/// Closes itself.
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

/// The head of a request, as far as it comes in one or two seconds and is no longer than it should be.
std::string head_of_request(int from) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(1);
  constexpr std::size_t most = 16 * 1024;
  std::string head;
  char piece[2048];
  while (head.size() < most && head.find("\r\n\r\n") == head.npos && Clock::now() < end) {
    const auto n = ::recv(from, piece, sizeof piece, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    head.append(piece, static_cast<std::size_t>(n));
  }
  return head;
}

/// Whoever says nothing, or does not read, is left.
void set_patience(int client) {
  const timeval to_say{1, 0}, to_read{10, 0};
  setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &to_say, sizeof to_say);
  setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &to_read, sizeof to_read);
}

/// Only what asks for this address by its number or as localhost: a page of another site may give its name to
/// 127.0.0.1.
bool is_meant(std::string_view request, std::uint16_t port) {
  const std::string head = lower_case(request);
  return head.find(fmt::format("\r\nhost: 127.0.0.1:{}\r\n", port)) != head.npos ||
         head.find(fmt::format("\r\nhost: localhost:{}\r\n", port)) != head.npos;
}

/// The address that a GET or HEAD asks for; empty: something else.
std::string_view address_of(std::string_view head) {
  const auto line = head.substr(0, head.find("\r\n"));
  const auto begin = line.find(' ');
  const auto method = line.substr(0, begin);
  if (begin == line.npos || (method != "GET" && method != "HEAD")) return {};
  const auto address = line.substr(begin + 1);
  return address.substr(0, address.find(' '));
}

void answer(int to, std::uint16_t port, const Site& site) {
  set_patience(to);
  const auto head = head_of_request(to);
  const auto address = is_meant(head, port) ? address_of(head) : std::string_view();
  const auto found = address.starts_with('/') ? site(address) : std::nullopt;
  const std::string_view body = found ? *found->bytes : std::string_view("not found\n");
  send_all(to, fmt::format("HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n"
                           "X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n",
                           found ? "200 OK" : "404 Not Found", found ? found->type : "text/plain; charset=utf-8",
                           body.size()));
  if (!head.starts_with("HEAD ")) send_all(to, body);
}

std::string reason() { return std::generic_category().message(errno); }

}  // namespace

std::string serve_site(const Site& site) {
  constexpr int most_clients = 32;  // at one time
  const Socket listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  auto* address = reinterpret_cast<sockaddr*>(&here);
  if (listener < 0 || ::bind(listener, address, size) != 0 || ::listen(listener, most_clients) != 0 ||
      ::getsockname(listener, address, &size) != 0)
    return reason();
  const auto port = ntohs(here.sin_port);
  fmt::print("http://127.0.0.1:{}/\n", port);
  std::fflush(stdout);
  // The site outlives the threads: only the end of the process ends this loop as long as the listener is
  // there.
  static std::counting_semaphore<most_clients> places(most_clients);
  for (;;) {
    places.acquire();
    const int client = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
    if (client >= 0) {
      std::thread([client, port, &site] {
        answer(client, port, site);
        ::close(client);
        places.release();
      }).detach();
      continue;
    }
    places.release();
    if (errno != EINTR && errno != ECONNABORTED) return reason();
  }
}

}  // namespace wrlkit

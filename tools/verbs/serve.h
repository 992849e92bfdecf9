#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace wrlkit {

/// The answer to a request for an address.
struct Served {
  std::string_view type;  // MIME, of static storage
  std::shared_ptr<const std::string> bytes;
};

/// What lies at an address, which begins with '/', as it is now; nothing when there is nothing. Asked by several
/// threads.
using Site = std::function<std::optional<Served>(std::string_view address)>;

constexpr std::string_view html_type = "text/html; charset=utf-8";

/// Shows a site at http://127.0.0.1 (an address that only this machine reaches), at a port that is free, and prints the
/// address. Ends with the process; returns only when it cannot begin, with the reason.
std::string serve_site(const Site&);

}  // namespace wrlkit

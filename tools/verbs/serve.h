#pragma once
#include <functional>
#include <memory>
#include <string>

namespace wrlkit {

/// The page as it is now; asked for by several threads.
using PageSource = std::function<std::shared_ptr<const std::string>()>;

/// Shows one page at http://127.0.0.1 (an address that only this machine reaches), at a port that is free, and prints
/// the address. Ends with the process; returns only when it cannot begin, with the reason.
std::string serve_page(const PageSource&);

}  // namespace wrlkit

#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// Shows one page at http://127.0.0.1 (an address that only this machine reaches), at a port that is free, and prints the
/// address. Ends with the process; returns only when it cannot begin, with the reason.
std::string serve_page(std::string_view html);

}  // namespace wrlkit

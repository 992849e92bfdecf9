// Sizes and times as options and recipes write them.
#pragma once
#include <cstdint>
#include <string>

namespace wrlkit {

/// "8G", "800MB", "1.5 GiB" in bytes, by powers of 1024; 0 when it is not a valid size.
std::uint64_t size_of(const std::string& text);
/// "90s", "10m", "2h" in seconds; 0 when it is not a valid time.
double seconds_of(const std::string& text);

}  // namespace wrlkit

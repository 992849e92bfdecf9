#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// Bytes as text (RFC 4648, 4).
std::string base64(std::string_view bytes);

}  // namespace wrlkit

#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace wrlkit {

/// Bytes as text (RFC 4648, 4).
std::string base64(std::string_view bytes);
/// The bytes again; none when a character does not belong there. Both alphabets are read (4 and 5); blanks are skipped,
/// padding may be missing.
std::optional<std::string> base64_decode(std::string_view text);

}  // namespace wrlkit

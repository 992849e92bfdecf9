// UTF-8, and encodings that occur in files which claim to be it.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace wrlkit {

void append_utf8(std::string& out, std::uint32_t code_point);
/// Length of the well-formed sequence that the text begins with, 0 when there is none (Unicode, table 3-7).
std::size_t utf8_sequence(std::string_view);
bool is_utf8(std::string_view);
/// Every byte a character (ISO 8859-1); never fails, so nothing is lost even when the text was in yet another encoding.
std::string latin1_to_utf8(std::string_view);
/// UTF-16 with a byte-order mark to UTF-8; unpaired surrogates become U+FFFD.
std::string utf16_to_utf8(std::string_view);

}  // namespace wrlkit

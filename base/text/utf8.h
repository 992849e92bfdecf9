// Encodings that occur in files which claim to be UTF-8.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit::vrml {

bool is_utf8(std::string_view);
/// Every byte a character (ISO 8859-1); never fails, so nothing is lost even when the text was in yet another encoding.
std::string latin1_to_utf8(std::string_view);
/// UTF-16 with a byte-order mark to UTF-8; unpaired surrogates become U+FFFD.
std::string utf16_to_utf8(std::string_view);

}  // namespace wrlkit::vrml

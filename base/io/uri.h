// Names of files as references to them write them.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// Unreserved characters and '/' as they are, everything else as %XX (RFC 3986, 2.3; of VRML, ISO/IEC 14772-1, 4.5.1).
std::string uri_of(std::string_view path);
/// The other way; a '%' that no two hexadecimal digits follow is itself.
std::string percent_decode(std::string_view s);

}  // namespace wrlkit

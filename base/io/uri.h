// Names of files as references to them write them.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// Unreserved characters as they are, everything else as %XX (RFC 3986, 2.3; of VRML, ISO/IEC 14772-1, 4.5.1).
std::string uri_of(std::string_view file_name);

}  // namespace wrlkit

// Text in a table of comma-separated values.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// In quotation marks, those inside doubled (RFC 4180).
inline std::string csv_quoted(std::string_view s) {
  std::string out = "\"";
  for (char c : s) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

/// In quotation marks only where that is needed.
inline std::string csv_text(std::string_view s) {
  return s.find_first_of(",\"\n\r") == s.npos ? std::string(s) : csv_quoted(s);
}

}  // namespace wrlkit

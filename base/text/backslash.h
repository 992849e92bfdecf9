// Strings in quotes with backslashes, as VRML, X3D's MFString and pipeline texts write them.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// Calls plain(piece) for what is between quotes and backslashes, and escape(c) for each of those.
void by_escapes(std::string_view s, const auto& plain, const auto& escape) {
  for (;;) {
    const auto at = s.find_first_of("\"\\");
    plain(s.substr(0, at));
    if (at == s.npos) return;
    escape(s[at]);
    s.remove_prefix(at + 1);
  }
}

inline std::string in_quotes(std::string_view s) {
  std::string out = "\"";
  by_escapes(
      s, [&](std::string_view piece) { out += piece; }, [&](char c) { (out += '\\') += c; });
  return out + '"';
}

}  // namespace wrlkit

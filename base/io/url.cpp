#include "base/io/url.h"

#include <algorithm>
#include <cctype>

#include "base/io/uri.h"
#include "base/text/base64.h"
#include "base/text/blanks.h"
#include "base/text/letter_case.h"

namespace wrlkit {
namespace {

/// The scheme in lower case; empty when there is none. One letter is a drive.
std::string scheme(std::string_view url) {
  auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '.' || c == '-'; };
  std::string s(url.substr(0, std::min(url.size(), url.find(':'))));
  if (s.size() < 2 || s.size() == url.size() || !std::isalpha(static_cast<unsigned char>(s[0])) ||
      !std::ranges::all_of(s, allowed))
    return {};
  return lower_case(s);
}

/// The path in "file:..." (RFC 8089), whose forms on other systems are "file:///C:/x", "file:///C|/x" and
/// "file://C:/x".
std::string_view path_of_file_url(std::string_view s) {
  s.remove_prefix(5);
  if (s.starts_with("//localhost/")) return s.substr(11);
  if (s.starts_with("///")) return s.substr(2);
  if (s.starts_with("//") && has_drive(s.substr(2))) return s.substr(2);
  return s;
}

std::string with_slashes(std::string s) {
  std::ranges::replace(s, '\\', '/');
  if (s.starts_with('/') && has_drive(std::string_view(s).substr(1))) s.erase(0, 1);
  if (has_drive(s)) s[1] = ':';
  return s;
}

}  // namespace

UrlKind url_kind(std::string_view url) {
  auto s = scheme(trim(url));
  if (s.empty() || s == "file") return UrlKind::file;
  if (s == "data") return UrlKind::data;
  return s == "javascript" || s == "vrmlscript" || s == "ecmascript" ? UrlKind::script : UrlKind::remote;
}

bool has_drive(std::string_view p) {
  return p.size() >= 2 && std::isalpha(static_cast<unsigned char>(p[0])) && (p[1] == ':' || p[1] == '|') &&
         (p.size() == 2 || p[2] == '/' || p[2] == '\\');
}

std::vector<std::string> url_paths(std::string_view url) {
  url = trim(url);
  std::string slashed(url);
  std::ranges::replace(slashed, '\\', '/');  // file:\\\C:\x
  std::string_view path = scheme(url) == "file" ? path_of_file_url(slashed) : slashed;
  auto bare = path.substr(0, std::min(path.size(), path.find_first_of("#?")));
  std::vector<std::string> paths{with_slashes(percent_decode(bare))};
  for (auto other : {with_slashes(std::string(bare)), with_slashes(std::string(path)), std::string(url)})
    if (std::ranges::find(paths, other) == paths.end()) paths.push_back(std::move(other));
  return paths;
}

bool is_relative_url(std::string_view url) {
  return !url.empty() && url[0] != '/' && url[0] != '\\' && url[0] != '#' && url.find(':') == url.npos;
}

std::optional<std::string> decode_data_url(std::string_view url) {
  url = trim(url);
  auto comma = url.find(',');
  if (comma == url.npos) return std::nullopt;
  auto about = url.substr(0, comma), content = url.substr(comma + 1);
  auto decoded = percent_decode(content);
  return about.ends_with(";base64") ? base64_decode(decoded) : decoded;
}

std::string data_url(std::string_view media_type, std::string_view bytes) {
  return "data:" + std::string(media_type) + ";base64," + base64(bytes);
}

}  // namespace wrlkit

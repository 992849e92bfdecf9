// What the urls of VRML files mean, as far as that can be known without looking at files. Exporters on other systems
// wrote many of them, so backslashes, drive letters and file names that were never percent-encoded are understood.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

/// data: the content itself (RFC 2397). script: code for a Script node. remote: any other scheme, urn: included.
enum class UrlKind { file, data, script, remote };
UrlKind url_kind(std::string_view url);

/// The paths that a url of kind `file` may mean, the likeliest first: without query and fragment and percent-decoded
/// (RFC 3986), then as it is written. Absolute paths begin with '/', or with a drive: "C:/". Never empty.
std::vector<std::string> url_paths(std::string_view url);

/// Whether it leads from the file in which it stands to another one: no scheme, no drive, no path from the root, and
/// more than a fragment.
bool is_relative_url(std::string_view url);

/// "C:/..." of other systems.
bool has_drive(std::string_view path);

std::optional<std::string> decode_data_url(std::string_view url);
/// The url that is those bytes, in base64.
std::string data_url(std::string_view media_type, std::string_view bytes);

}  // namespace wrlkit

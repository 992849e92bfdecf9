// Whether a file is what would be written in its place.
#pragma once
#include <span>
#include <string>
#include <string_view>

namespace wrlkit {

/// Whether a file is there that holds these pieces, one after another, and nothing else.
bool has_contents(const std::string& path, std::span<const std::string_view> pieces);

}  // namespace wrlkit

// PNG (ISO/IEC 15948) as a list of chunks.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace wrlkit {

/// The picture without the chunks that do not change its pixels: colour profiles, times, texts. Nothing when a chunk is
/// damaged or missing. libpng prints its complaints about either kind, which a library must not; and what a file says
/// about when and by what it was made would make equal pictures differ.
std::optional<std::string> essential_png(std::string_view png);

}  // namespace wrlkit

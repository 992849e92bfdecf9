// Memory of a text that is mapped from its file (read_file.h).
#pragma once
#include <string_view>

namespace wrlkit {

/// The whole pages within a part of a text leave memory, and come from the file again when they are touched. Nothing
/// happens to a text in memory of its own, which could be written. For parts that are not looked at for some time; on
/// any thread.
void release_pages(std::string_view part);

}  // namespace wrlkit

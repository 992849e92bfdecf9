// When the first corpus run into a folder began: what is older there was not made by a run.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace wrlkit {

using FileTime = std::pair<std::int64_t, std::int64_t>;  // seconds, nanoseconds

/// When a file was last changed in any way, by the clock of its disk; nothing when there is no such file.
std::optional<FileTime> change_time(const std::string& path);

/// Notes the time, where no run has been in the folder. False when that cannot be written.
bool note_first_run(const std::string& out);
/// Nothing when it is not known: the first run was one of wrlkit 0.2.0.
std::optional<FileTime> time_of_first_run(const std::string& out);

}  // namespace wrlkit

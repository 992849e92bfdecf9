// Locks on open files and folders, between processes (flock). They end with the process that holds them, however it
// ends.
#pragma once
#include <chrono>
#include <cstdint>

namespace wrlkit {

enum class FileLock : std::uint8_t { shared, exclusive };

/// Locks an open file, or changes the lock that it has. False when another process has it, or the file system has no
/// locks, and that is still so after `patience`: processes that were killed a moment ago hold theirs until they are
/// gone.
bool lock_file(int fd, FileLock, std::chrono::milliseconds patience = {});
void unlock_file(int fd);

}  // namespace wrlkit

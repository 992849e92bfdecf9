#include "base/io/file_lock.h"

#include <sys/file.h>

#include <thread>

namespace wrlkit {

bool lock_file(int fd, FileLock lock, std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds pause(100);
  const int how = (lock == FileLock::shared ? LOCK_SH : LOCK_EX) | LOCK_NB;
  for (; flock(fd, how) != 0; patience -= pause) {
    if (patience < pause) return false;
    std::this_thread::sleep_for(pause);
  }
  return true;
}

void unlock_file(int fd) { flock(fd, LOCK_UN); }

}  // namespace wrlkit

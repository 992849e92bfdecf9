// What this process may no longer do.
#pragma once

namespace wrlkit {

/// Two seconds of processor time, no files beyond those that are open, no more memory than the engine and itself need,
/// no system calls but those of reading, writing, memory and ending. False when the system refuses.
bool enter_sandbox();

}  // namespace wrlkit

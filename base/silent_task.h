// A task whose messages and counts are not used.
#pragma once
#include "base/task.h"

namespace wrlkit {

struct Unread {
  Diagnostics messages;
  Statistics counts;
};

/// For looking at something before it is written or drawn; its faults are reported then. It stops when
/// `task` does.
class SilentTask : private Unread, public Task {
 public:
  explicit SilentTask(const Task& task)
      : Unread{Diagnostics(task.diag.shared_sources()), {}}, Task{messages, counts, nullptr, task.stop} {}
  SilentTask(const SilentTask&) = delete;
  SilentTask& operator=(const SilentTask&) = delete;
};

}  // namespace wrlkit

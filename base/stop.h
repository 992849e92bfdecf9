// How long work ends before its time: loops deep down ask for it, without being given anything.
#pragma once
#include <stop_token>

namespace wrlkit {

/// What long work throws when it is to stop. Caught where the StopScope stands.
struct Stopped {};

/// As long as one of these lives, long loops on this thread, and all that parallel_for does for it, throw Stopped once
/// the token asks for it. The token must outlive it.
class StopScope {
 public:
  explicit StopScope(const std::stop_token& token);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

  /// The token of this thread; null: it cannot be stopped.
  static const std::stop_token* current();

 private:
  const std::stop_token* before_;
};

/// For serial loops: throws Stopped when this thread's work is to stop. An atomic read.
void check_stop();

}  // namespace wrlkit

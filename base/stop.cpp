#include "base/stop.h"

namespace wrlkit {
namespace {

thread_local const std::stop_token* token_of_thread = nullptr;

}  // namespace

StopScope::StopScope(const std::stop_token& token) : before_(token_of_thread) { token_of_thread = &token; }
StopScope::~StopScope() { token_of_thread = before_; }

const std::stop_token* StopScope::current() { return token_of_thread; }

void check_stop() {
  if (token_of_thread && token_of_thread->stop_requested()) throw Stopped{};
}

}  // namespace wrlkit

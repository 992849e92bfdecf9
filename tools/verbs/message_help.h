// What a message means, for `wrlkit explain`.
#pragma once
#include <string>
#include <string_view>

#include "base/diagnostics.h"

namespace wrlkit {

struct MessageExplanation {
  std::string example;               // the message with an example in its places
  std::string_view why, what_to_do;  // empty: not known
};
MessageExplanation message_explanation(Diag);

/// The message with an example in its places, why it comes, and what to do, as far as these are known
/// (message_help.def); otherwise what its severity means. Ends with a line break.
std::string message_help(Diag);

}  // namespace wrlkit

// What passes between wrlkit and the process in which Scripts run: frames of a kind, the number of a Script, and JSON.
#pragma once
#include <cstdint>

namespace wrlkit {

enum class FrameKind : std::uint8_t {
  load = 'L',    // to the process: fields and text of a Script
  call = 'C',    // to it: a function that is to be called
  drop = 'D',    // to it: a Script is needed no more; without an answer
  result = 'R',  // from it: the answer to load and call
  ask = 'Q',     // from it, before a result
  answer = 'A',  // to it: the answer to ask
};

struct FrameHead {
  FrameKind kind{};
  std::uint8_t unused[3]{};
  std::uint32_t script = 0;
  std::uint32_t bytes = 0;  // that follow
  std::uint32_t first = 0;  // of load: bytes of the fields; the text follows them
};
static_assert(sizeof(FrameHead) == 16);

/// A frame holds no more than that.
inline constexpr std::uint32_t most_frame_bytes = 8 << 20;

}  // namespace wrlkit

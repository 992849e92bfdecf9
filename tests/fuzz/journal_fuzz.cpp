// What must hold of any bytes as a line of the journal of a corpus run: no line, or one that is written and read back
// as the same.
#include "tests/fuzz/harness.h"
#include "tools/corpus/journal.h"

using namespace wrlkit;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto line = journal_line(text_of(data, size));
  if (!line) return 0;
  const auto text = to_json(*line);
  require(text.find('\n') == text.npos || line->messages.find('\n') != line->messages.npos, "a line of several lines");
  const auto again = journal_line(text);
  require(again.has_value(), "what was written is not read: " + text);
  require(to_json(*again) == text, "what was written reads as another line: " + text + "\nthen\n" + to_json(*again));
  return 0;
}

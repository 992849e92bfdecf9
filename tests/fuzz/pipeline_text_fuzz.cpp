// What must hold of any bytes as the text of a pipeline: why it is none, or a pipeline whose text reads as the same
// pipeline, also with what a writer needs.
#include "tests/fuzz/harness.h"

using namespace wrlkit;

namespace {

void read_back(const Pipeline& pipeline) {
  std::string why;
  const auto again = Pipeline::parse(pipeline.text(), why);
  require(again.has_value(), "what was written is not read: " + why + "\n" + pipeline.text());
  require(again->text() == pipeline.text(), "what was written reads as another pipeline: " + pipeline.text());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string why;
  auto pipeline = Pipeline::parse(text_of(data, size), why);
  require(pipeline.has_value() == why.empty(), "neither a pipeline nor why not, or both");
  if (!pipeline) return 0;
  read_back(*pipeline);
  for (const auto& named : named_pipelines()) {
    auto completed = *Pipeline::parse(pipeline->text(), why);
    completed.complete(named.text);
    read_back(completed);
  }
  return 0;
}

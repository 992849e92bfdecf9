// What a corpus run would replace that no corpus run has made.
#pragma once
#include <cstddef>
#include <string>

#include "tools/corpus/plan.h"

namespace wrlkit {

struct ForeignOutputs {
  std::size_t count = 0;
  std::string first;
};

/// Files in the way of the outputs of a plan, where there has been no run in that folder. O(files).
ForeignOutputs foreign_outputs(const CorpusPlan&, const std::string& folder);

}  // namespace wrlkit

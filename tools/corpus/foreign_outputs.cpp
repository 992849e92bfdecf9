#include "tools/corpus/foreign_outputs.h"

#include <filesystem>

#include "tools/corpus/journal.h"

namespace wrlkit {

ForeignOutputs foreign_outputs(const CorpusPlan& plan, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code none;
  ForeignOutputs out;
  if (fs::exists(corpus_folder(folder), none) || !fs::exists(folder, none)) return out;
  for (const auto& job : plan.jobs) {
    const auto path = fs::path(folder) / job.output;
    if (fs::exists(path, none) && out.count++ == 0) out.first = path.string();
  }
  // Another process of the same run may have begun meanwhile.
  return fs::exists(corpus_folder(folder), none) ? ForeignOutputs{} : out;
}

}  // namespace wrlkit

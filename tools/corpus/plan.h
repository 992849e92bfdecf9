// What a corpus run is going to do: a job for each file, with its place in the mirrored tree, what it is likely to
// cost, and the shard that does it. The same inputs give the same plan, so shards need not talk to one
// another.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/cli/inputs.h"

namespace wrlkit {

struct CorpusJob {
  InputFile input;
  std::string output;        // below the folder of the run
  double cost = 0;           // seconds, roughly: only their ratios count
  std::uint64_t memory = 0;  // bytes, roughly
  std::uint32_t shard = 0;   // from 0
};

struct CorpusPlan {
  std::vector<std::string> roots;
  std::vector<CorpusJob> jobs;                             // the dearest first
  std::unordered_map<std::string, std::uint32_t> by_path;  // the job of an input
  std::vector<std::pair<std::string, std::string>> kept;   // inputs whose outputs keep the input's ending in their
                                                           // names, and the output that several of them would have had
};

struct Shard {
  std::uint32_t index = 0, count = 1;
};

/// "2/8": the second of eight; "auto", "auto/8": by the environment of a Slurm array (SLURM_ARRAY_TASK_ID, _MIN,
/// _COUNT) or of an indexed job of Kubernetes (JOB_COMPLETION_INDEX). Nothing, and why, when it is none.
std::optional<Shard> parse_shard(const std::string& text, std::string& why);

/// `ending`: of the outputs, "glb". Outputs that would have the same name keep the ending of their inputs: pump.wrl and
/// pump.x3d become pump.wrl.glb and pump.x3d.glb. Nothing, and why, when some would have the same name even so. O(n log
/// n).
std::optional<CorpusPlan> plan_corpus(Inputs inputs, const std::string& ending, std::uint32_t shards, std::string& why);

}  // namespace wrlkit

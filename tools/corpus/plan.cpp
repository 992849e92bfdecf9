#include "tools/corpus/plan.h"

#include <algorithm>
#include <cstdlib>
#include <queue>
#include <unordered_map>

#include "base/math/digits.h"
#include "convert/formats.h"

namespace wrlkit {
namespace {

// For conversions to glTF (docs/performance.md): a process, and a cost per byte of text. gzip packs VRML to a sixth or
// so.
constexpr double process_seconds = 0.002, seconds_a_byte = 1e-8;
constexpr std::uint64_t process_bytes = 48 << 20, bytes_a_byte = 12, gzip_ratio = 8;

void estimate(CorpusJob& job) {
  const auto& name = job.input.path;
  const auto ending = ending_of(name, scene_endings());
  const bool packed = is_packed_ending(ending) || ending == ".glb";
  const auto bytes = job.input.bytes * (packed ? gzip_ratio : 1);
  job.cost = process_seconds + seconds_a_byte * static_cast<double>(bytes);
  job.memory = process_bytes + bytes_a_byte * bytes;
}

std::string stem(const InputFile& file) { return without_ending(file.inside).value_or(file.inside); }

/// Places in the mirrored tree, each once.
bool place(CorpusPlan& plan, const std::string& ending, std::string& why) {
  std::unordered_map<std::string, std::uint32_t> wanted;
  for (auto& job : plan.jobs)
    ++wanted[job.output = job.input.asset ? job.input.inside : stem(job.input) + "." + ending];
  for (auto& job : plan.jobs)
    if (!job.input.asset && wanted[job.output] > 1) {
      plan.kept.emplace_back(job.input.path, job.output);
      job.output = job.input.inside + "." + ending;
    }
  if (plan.kept.empty()) return true;
  std::unordered_map<std::string, const CorpusJob*> taken;
  for (auto& job : plan.jobs) {
    const auto [at, is_new] = taken.try_emplace(job.output, &job);
    if (!is_new) {
      why = "'" + at->second->input.path + "' and '" + job.input.path + "' would both become '" + job.output +
            "'; give them folders of their own, or a list with --base";
      return false;
    }
  }
  return true;
}

/// Longest processing time first: no shard has more than 4/3 of what the best division has (Graham).
void divide(std::vector<CorpusJob>& jobs, std::uint32_t shards) {
  using Load = std::pair<double, std::uint32_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::uint32_t s = 0; s < shards; ++s) loads.emplace(0.0, s);
  for (auto& job : jobs) {
    auto [load, shard] = loads.top();
    loads.pop();
    job.shard = shard;
    loads.emplace(load + job.cost, shard);
  }
}

std::optional<std::uint32_t> number(std::string_view text) {
  std::uint32_t v = 0;
  return read_number(text, v) ? std::optional(v) : std::nullopt;
}

std::optional<std::uint32_t> from_environment(const char* name) {
  const char* text = std::getenv(name);
  return text ? number(text) : std::nullopt;
}

}  // namespace

std::optional<Shard> parse_shard(const std::string& text, std::string& why) {
  const auto slash = text.find('/');
  const auto first = text.substr(0, slash);
  std::optional<std::uint32_t> count;
  if (slash != text.npos) count = number(std::string_view(text).substr(slash + 1));
  std::optional<std::uint32_t> index;
  if (first == "auto") {
    if (auto id = from_environment("SLURM_ARRAY_TASK_ID")) {
      index = *id - from_environment("SLURM_ARRAY_TASK_MIN").value_or(0);
      if (!count) count = from_environment("SLURM_ARRAY_TASK_COUNT");
    } else {
      index = from_environment("JOB_COMPLETION_INDEX");
    }
    if (!index) {
      why = "neither SLURM_ARRAY_TASK_ID nor JOB_COMPLETION_INDEX says which shard this is";
      return std::nullopt;
    }
    if (!count) {
      why = "how many shards are there? auto/8 says eight";
      return std::nullopt;
    }
  } else if (auto i = number(first); i && *i > 0) {
    index = *i - 1;
  }
  if (!index || !count || *index >= *count) {
    why = "'" + text + "' is not a valid shard; 2/8 is the second of eight";
    return std::nullopt;
  }
  return Shard{*index, *count};
}

std::optional<CorpusPlan> plan_corpus(Inputs inputs, const std::string& ending, std::uint32_t shards,
                                      std::string& why) {
  CorpusPlan plan;
  plan.roots = std::move(inputs.roots);
  plan.jobs.reserve(inputs.files.size());
  for (auto& file : inputs.files) {
    CorpusJob job;
    job.input = std::move(file);
    estimate(job);
    plan.jobs.push_back(std::move(job));
  }
  if (!place(plan, ending, why)) return std::nullopt;
  std::ranges::stable_sort(plan.jobs, std::greater{}, &CorpusJob::cost);
  divide(plan.jobs, shards);
  for (std::uint32_t i = 0; i < plan.jobs.size(); ++i) plan.by_path.emplace(plan.jobs[i].input.path, i);
  return plan;
}

}  // namespace wrlkit

// What the flags of a corpus run ask for: its plan, the jobs of the shard, and whether they may be done.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/cli/cli.h"
#include "tools/corpus/conversion.h"

namespace wrlkit {

/// Nothing when something is wrong with them, which was printed.
std::optional<CorpusWork> asked_work(const Flags& flags);

struct Planned {
  CorpusPlan plan;
  std::vector<std::string> left_out;
  Shard shard;
  std::vector<std::uint32_t> ours;  // the jobs of the shard
};

/// Nothing when something is wrong, which was printed; `code` is that of the verb then.
std::optional<Planned> plan_of(std::string_view verb, const Flags& flags, bool assets, int& code);

/// The jobs of the shard whose outputs are there.
std::vector<std::uint32_t> existing_outputs(const Planned& planned, const std::string& folder);
/// Whether there are files of others where outputs go, which is printed.
bool is_refused(const std::vector<std::uint32_t>& in_the_way, const Planned& planned, const Flags& flags);

}  // namespace wrlkit

// wrlkit corpus plan: what a run would do, and how it is divided; nothing is written.
#include <fmt/format.h>

#include <filesystem>

#include "base/text/json.h"
#include "tools/cli/documents.h"
#include "tools/corpus/planned.h"
#include "tools/corpus/shell_word.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

/// False when the report cannot be written, which was printed.
bool give_plan(const Planned& p, const Flags& flags) {
  std::string json_text;
  JsonOut json(json_text);
  json.begin_array();
  if (!flags.json) fmt::print("shard\tseconds\tbytes\tinput\toutput\n");
  for (const auto& job : p.plan.jobs) {
    if (!flags.shard.empty() && job.shard != p.shard.index) continue;
    const auto output = (fs::path(flags.output) / job.output).string();
    json.object("shard", job.shard + 1, "seconds", job.cost, "bytes", job.input.bytes, "input", job.input.path,
                "output", output);
    if (!flags.json)
      fmt::print("{}/{}\t{:.3f}\t{}\t{}\t{}\n", job.shard + 1, p.shard.count, job.cost, job.input.bytes,
                 in_one_field(job.input.path), in_one_field(output));
  }
  json.end_array();
  return give_document(flags, json_text);
}

}  // namespace

int run_corpus_plan(const Flags& flags) {
  const auto work = asked_work(flags);
  if (!work) return usage;
  int code = usage;
  const auto planned = plan_of("corpus plan", flags, work->text, code);
  if (!planned) return code;
  if (!give_plan(*planned, flags)) return nothing;
  return planned->left_out.empty() ? done : partly;
}

}  // namespace wrlkit

#include "tools/corpus/planned.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "tools/cli/documents.h"
#include "tools/cli/inputs.h"
#include "tools/cli/print_diagnostics.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

/// Where a word means all that lies below: a folder, or a glob with "**". Nothing where it means files.
std::optional<fs::path> folder_below(const std::string& word) {
  std::error_code none;
  if (fs::is_directory(word, none)) return word;
  if (word.find("**") == word.npos) return std::nullopt;
  const auto front = fs::path(word.substr(0, word.find_first_of("*?["))).parent_path();
  return front.empty() ? "." : front;
}

/// Whether the outputs would be written among the inputs: into one of their folders, or into one below with scenes
/// that no run has made.
bool is_input_folder(const CorpusPlan& plan, const std::vector<std::string>& words, const std::string& out) {
  std::error_code none;
  const auto there = fs::weakly_canonical(out, none);
  if (std::ranges::any_of(plan.roots, [&](const auto& root) { return fs::weakly_canonical(root, none) == there; }))
    return true;
  const bool is_below = std::ranges::any_of(words, [&](const std::string& word) {
    const auto folder = folder_below(word);
    return folder && !there.lexically_relative(fs::weakly_canonical(*folder, none)).native().starts_with("..");
  });
  if (!is_below || !fs::is_directory(there, none) || fs::exists(corpus_folder(out), none)) return false;
  std::string unsaid;
  const auto inputs = gather_inputs({out}, {}, unsaid);
  return inputs && !inputs->files.empty();
}

}  // namespace

std::optional<CorpusWork> asked_work(const Flags& flags) {
  std::string why;
  auto work = corpus_work(flags, why);
  if (!work) fmt::print(stderr, "{}", why);
  return work;
}

std::optional<Planned> plan_of(std::string_view verb, const Flags& flags, bool assets, int& code) {
  code = usage;
  std::string why;
  Planned p;
  const auto fail = [&] {
    complain(verb, why);
    return std::nullopt;
  };
  if (flags.output == "-") {
    why = "-o: a folder is needed; standard output is none";
    return fail();
  }
  if (std::error_code none; !flags.base.empty() && !fs::is_directory(flags.base, none)) {
    why = "--base: there is no folder '" + flags.base + "'";
    return fail();
  }
  if (!flags.shard.empty()) {
    const auto shard = parse_shard(flags.shard, why);
    if (!shard) return fail();
    p.shard = *shard;
  }
  auto inputs = gather_inputs(flags.inputs,
                              {.include = flags.include,
                               .exclude = flags.exclude,
                               .base = flags.base,
                               .output = flags.output,
                               .assets = assets},
                              why);
  if (!inputs) {
    code = nothing;
    return fail();
  }
  p.left_out = std::move(inputs->left_out);
  print_left_out(verb, p.left_out, inputs->passed_over);
  auto plan = plan_corpus(std::move(*inputs), flags.format, p.shard.count, why);
  if (!plan) return fail();
  p.plan = std::move(*plan);
  for (std::uint32_t i = 0; i < p.plan.jobs.size(); ++i)
    if (flags.shard.empty() || p.plan.jobs[i].shard == p.shard.index) p.ours.push_back(i);
  if (is_input_folder(p.plan, flags.inputs, flags.output)) {
    why = "'" + flags.output + "' is a folder of inputs; the outputs need one of their own";
    return fail();
  }
  return p;
}

std::vector<std::uint32_t> existing_outputs(const Planned& p, const std::string& folder) {
  std::error_code none;
  std::vector<std::uint32_t> out;
  if (!fs::exists(folder, none)) return out;
  std::ranges::copy_if(p.ours, std::back_inserter(out),
                       [&](std::uint32_t at) { return fs::exists(fs::path(folder) / p.plan.jobs[at].output, none); });
  return out;
}

bool is_refused(const std::vector<std::uint32_t>& in_the_way, const Planned& planned, const Flags& flags) {
  if (in_the_way.empty() || flags.overwrite) return false;
  const auto first = fs::path(flags.output) / planned.plan.jobs[in_the_way[0]].output;
  complain("corpus run", fmt::format("'{}' holds {} that no corpus run has made, such as '{}'; choose another folder, "
                                     "or say --overwrite",
                                     flags.output, counted(in_the_way.size(), "file"), first.string()));
  return true;
}

}  // namespace wrlkit

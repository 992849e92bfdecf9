#include "tools/cli/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/text/letter_case.h"
#include "convert/formats.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> inputs_of(const Flags& flags) {
  auto out = flags.inputs;
  out.insert(out.end(), flags.python.begin(), flags.python.end());
  out.push_back(flags.compare);
  out.push_back(flags.recipe);
  return out;
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code fault;
  return fs::is_regular_file(a, fault) && fs::equivalent(a, b, fault);
}

/// Prints why not.
bool is_no_input(const Flags& flags, const std::string& output, std::string_view option) {
  for (const auto& input : inputs_of(flags)) {
    if (!is_same_file(input, output)) continue;
    const bool could_replace = option.empty() && !flags.inputs.empty() && input == flags.inputs[0];
    if (could_replace && flags.load.in_place) continue;
    fmt::print(
        stderr, "wrlkit: {}{}'{}' is an input of this command, which it would overwrite; choose another name{}\n",
        option, option.empty() ? "" : " ", output, could_replace && flags.can_replace ? ", or say --in-place" : "");
    return false;
  }
  return true;
}

bool has_ending(std::string_view name, std::string_view endings) {
  while (!endings.empty()) {
    const auto end = std::min(endings.find(' '), endings.size());
    if (ends_with_ignoring_case(name, endings.substr(0, end))) return true;
    endings.remove_prefix(std::min(end + 1, endings.size()));
  }
  return false;
}

/// Devices and pipes are written to whatever their names are.
bool is_special(const std::string& path) {
  std::error_code fault;
  return path == "-" || (fs::exists(path, fault) && !fs::is_regular_file(path, fault));
}

bool fits(const std::string& output, std::string_view endings, std::string_view option) {
  if (output.empty() || endings.empty() || is_special(output) || has_ending(output, endings)) return true;
  std::string list(endings);
  for (auto at = list.find(' '); at != list.npos; at = list.find(' ', at + 2)) list.replace(at, 1, ", ");
  fmt::print(stderr, "wrlkit: {}{}'{}': its name should end in {}\n", option, option.empty() ? "" : " ", output, list);
  return false;
}

/// Lines are added to a joblog: a scene would be lost by it, an input or not.
bool is_no_scene(const std::string& joblog) {
  if (ending_of(joblog, scene_endings()).empty()) return true;
  fmt::print(stderr, "wrlkit: --joblog '{}' has the name of a scene; choose another name, such as jobs.tsv\n", joblog);
  return false;
}

}  // namespace

bool check_outputs(const Flags& flags, std::string_view endings) {
  const auto all = [&](const std::vector<std::string>& outputs, std::string_view option, std::string_view kinds) {
    return std::ranges::all_of(outputs, [&](const std::string& output) {
      return fits(output, kinds, option) && is_no_input(flags, output, option);
    });
  };
  return all({flags.output}, "", endings) && all(flags.outputs, "-o", endings) &&
         all({flags.report}, "--report", ".json") && all({flags.joblog}, "--joblog", "") && is_no_scene(flags.joblog);
}

Backup::Backup(const Flags& flags) {
  if (!flags.load.in_place || flags.inputs.empty() || !is_same_file(flags.inputs[0], flags.output)) return;
  std::error_code fault;
  const auto target = fs::canonical(flags.output, fault);
  const std::string first = flags.output + ".bak";
  path_ = first;
  for (int k = 2; fs::exists(fs::symlink_status(path_, fault)); ++k) path_ = first + "." + std::to_string(k);
  fs::create_hard_link(target, path_, fault);
  if (fault) fs::copy_file(target, path_, fault);
  if (!fault) return;
  fmt::print(stderr, "wrlkit: --in-place: '{}' cannot be written: {}\n", path_, fault.message());
  path_.clear();
  good_ = false;
}

Backup::~Backup() {
  std::error_code fault;
  if (!path_.empty()) fs::remove(path_, fault);
}

}  // namespace wrlkit

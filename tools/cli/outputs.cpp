#include "tools/cli/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/text/letter_case.h"
#include "convert/formats.h"
#include "tools/cli/inputs.h"

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

/// A file that a command is to write.
struct NamedOutput {
  std::string path, option;    // option: empty for OUT
  std::string_view endings;    // that its name may have; empty: any
  bool never_a_scene = false;  // its contents would be no scene, whatever its name is
};

std::string in_words(const NamedOutput& output) {
  return output.option + (output.option.empty() ? "'" : " '") + output.path + "'";
}

/// Prints why not.
bool is_no_input(const Flags& flags, const NamedOutput& output) {
  for (const auto& input : inputs_of(flags)) {
    if (!is_same_file(input, output.path)) continue;
    const bool could_replace = output.option.empty() && !flags.inputs.empty() && input == flags.inputs[0];
    if (could_replace && flags.load.in_place) continue;
    fmt::print(stderr, "wrlkit: {} is an input of this command, which it would overwrite; choose another name{}\n",
               in_words(output), could_replace && flags.can_replace ? ", or say --in-place" : "");
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
  return path == "-" ||
         (fs::exists(path, fault) && !fs::is_regular_file(path, fault) && !fs::is_directory(path, fault));
}

bool fits(const NamedOutput& output) {
  const auto endings = output.endings;
  if (endings.empty() || has_ending(output.path, endings)) return true;
  std::string list(endings);
  for (auto at = list.find(' '); at != list.npos; at = list.find(' ', at + 2)) list.replace(at, 1, ", ");
  fmt::print(stderr, "wrlkit: {}: its name should end in {}\n", in_words(output), list);
  return false;
}

/// Lines are added to a joblog, a checkpoint is removed in the end: a scene would be lost by it, an input or not.
bool is_no_scene(const NamedOutput& output) {
  if (!output.never_a_scene || ending_of(output.path, scene_endings()).empty()) return true;
  fmt::print(stderr, "wrlkit: {} has the name of a scene; choose another name{}\n", in_words(output),
             output.option == "--joblog" ? ", such as jobs.tsv" : "");
  return false;
}

/// The file that a name means behind links; neither it nor what they lead to need be there yet.
fs::path target_of(const std::string& name) {
  constexpr int most_links = 40;  // as Linux follows
  std::error_code fault;
  auto path = fs::absolute(name, fault);
  for (int i = 0; i < most_links && fs::is_symlink(fs::symlink_status(path, fault)); ++i)
    path = path.parent_path() / fs::read_symlink(path, fault);
  const auto target = fs::weakly_canonical(path, fault);
  return fault ? path : target;
}

bool are_one_file(const std::string& a, const std::string& b) {
  return is_same_file(a, b) || target_of(a) == target_of(b);
}

/// Prints which of them is one.
bool are_no_folders(std::span<const NamedOutput> outputs) {
  std::error_code fault;
  const auto folder = std::ranges::find_if(outputs, [&](const auto& o) { return fs::is_directory(o.path, fault); });
  if (folder == outputs.end()) return true;
  fmt::print(stderr, "wrlkit: {} is a folder; name a file in it\n", in_words(*folder));
  return false;
}

/// The outputs that options and arguments of the command line name.
std::vector<NamedOutput> outputs_of(const Flags& flags, std::string_view endings) {
  std::vector<NamedOutput> out{{flags.output, "", endings}};
  for (const auto& output : flags.outputs) out.push_back({output, "-o", endings});
  out.push_back({flags.report, "--report", ".json"});
  out.push_back({flags.joblog, "--joblog", "", true});
  std::erase_if(out, [](const NamedOutput& o) { return o.path.empty(); });
  return out;
}

/// Whether a command may write them, behind those that it may write; prints why not.
bool may_write(const Flags& flags, std::vector<NamedOutput> known, std::span<const NamedOutput> more) {
  for (const auto& output : more) {
    if (is_special(output.path)) continue;
    if (!is_no_input(flags, output)) return false;
    for (const auto& other : known) {
      if (is_special(other.path) || !are_one_file(other.path, output.path)) continue;
      fmt::print(stderr, "wrlkit: {} and {} are one file; choose another name\n", in_words(other), in_words(output));
      return false;
    }
    if (!fits(output) || !is_no_scene(output)) return false;
    known.push_back(output);
  }
  return true;
}

}  // namespace

bool check_outputs(const Flags& flags, std::string_view endings, std::string_view makes) {
  std::vector<NamedOutput> known;
  if (!makes.empty()) known.push_back({(fs::path(flags.output) / makes).string(), "", ""});
  const std::vector<NamedOutput> lists{{flags.report, "--report", ""}, {flags.joblog, "--joblog", ""}};
  return are_no_folders(lists) && may_write(flags, std::move(known), outputs_of(flags, endings));
}

bool check_written_files(const Flags& flags, std::span<const WrittenFileOption> files) {
  std::vector<NamedOutput> more;
  for (const auto& [option, file] : files)
    more.push_back({file.path, "-p " + option, file.endings, file.endings.empty()});
  if (!are_no_folders(more)) return false;
  if (!more.empty() && (flags.inputs.size() > 1 || std::ranges::any_of(flags.inputs, means_many))) {
    fmt::print(stderr, "wrlkit: {} names one file, which each of these worlds would replace\n", in_words(more[0]));
    return false;
  }
  return may_write(flags, outputs_of(flags, ""), more);
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

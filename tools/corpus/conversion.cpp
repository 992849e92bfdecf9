#include "tools/corpus/conversion.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "base/io/output.h"
#include "convert/formats.h"
#include "tools/cli/cli.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/recipe.h"
#include "tools/corpus/written_names.h"
#include "tools/verbs/convert.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view of_others =
    "no corpus run has made what is there, or it has been changed since; --overwrite replaces it";
constexpr std::uint64_t largest_asset = std::uint64_t{4} << 30;

std::vector<std::string> allowed_folders(const CorpusWork& work, const CorpusPlan& plan, const CorpusJob& job) {
  auto all = work.flags.load.allow_paths;
  all.push_back(plan.roots[job.input.root]);
  return all;
}

void use(const FileLookup& lookup, JournalLine& line) {
  const bool found = lookup.result.state == AllowedFiles::found || lookup.result.state == AllowedFiles::repaired;
  line.files.push_back({lookup.referrer, lookup.url, found ? lookup.result.path : "",
                        found ? hash_of_file(lookup.result.path).value_or(ContentHash{}) : ContentHash{}});
}

/// The first error, in one line; why nothing could be written comes before what was wrong with the input.
std::string cause_in(const Diagnostics& diag) {
  const auto is_error = [](const Message& m) { return m.severity == Severity::error; };
  const auto all = diag.messages();
  auto found = std::ranges::find(all, Diag::cannot_write, &Message::id);
  if (found == all.end()) found = std::ranges::find_if(all, is_error);
  if (found == all.end()) return "";
  const auto text = message_text(*found, diag.sources(), false);
  return text.substr(0, text.find('\n'));
}

bool copy(const std::string& from, const std::string& to, bool may_replace, std::string& cause) {
  Diagnostics diag;
  const auto bytes = read_bytes(from, largest_asset, cause);
  if (!bytes) return false;
  FilesWritten written;
  if (!may_replace) written.refusal = of_others;
  written.replaces_links = true;
  auto file = OutputFile::open(to, {.written = &written}, diag);
  if (file) file->write(*bytes);
  if (file && file->commit(diag)) return true;
  cause = cause_in(diag);
  return false;
}

/// A file below a folder as it is called there.
std::string name_below(const std::string& folder, const std::string& path) {
  std::error_code fault;
  return fs::weakly_canonical(path, fault).lexically_relative(fs::weakly_canonical(folder, fault)).generic_string();
}

/// What a conversion is to do besides what its flags say.
struct ConversionExtras {
  std::function<void(Scene&)> last;              // to the scene, before it is written
  std::function<void(const std::string&)> take;  // files that were written
  bool may_replace = false;                      // files that are there
};

bool convert(const Flags& flags, const ConversionExtras& extras, JournalLine& line) {
  Session s(flags);
  if (!prepare_conversion(s)) {
    line.cause = "the recipe does not fit";
    return false;
  }
  bool made = read_input(s);
  if (made) {
    auto& written = s.resources().files_written();
    if (!extras.may_replace) written.refusal = of_others;
    written.replaces_links = true;
    made = static_cast<bool>(write_world(s, save_options(flags), extras.last));
  }
  line.state = !made ? JobState::failed : s.diag().has_errors() ? JobState::made_partly : JobState::made;
  line.messages = messages_json(s.diag());
  if (!made) line.cause = cause_in(s.diag());
  for (const auto& lookup : s.document().lookups()) use(lookup, line);
  if (made) std::ranges::for_each(s.resources().files_written().paths(), extras.take);
  return made;
}

}  // namespace

std::string program_identity() {
  Dl_info info{};
  std::string file = "/proc/self/exe";
  if (dladdr(reinterpret_cast<void*>(&program_identity), &info) &&
      std::string_view(info.dli_fname).find(".so") != std::string_view::npos)
    file = info.dli_fname;
  return std::string(program_version()) + hash_of_file(file).value_or(ContentHash{}).hex();
}

std::optional<CorpusWork> corpus_work(const Flags& corpus_flags, std::string& why) {
  const auto recipe = read_recipe(corpus_flags.recipe, why);
  if (!recipe) return std::nullopt;
  CorpusWork work{.flags = conversion_flags(*recipe), .out = corpus_flags.output};
  auto& f = work.flags;
  f.warnings = corpus_flags.warnings;
  f.load.allow_paths = corpus_flags.load.allow_paths;
  f.load.strict = corpus_flags.load.strict;
  f.strict_paths = true;
  f.quiet = true;
  f.jobs = 1;
  f.memory.clear();
  f.output = "out." + corpus_flags.format;
  work.text = output_of(f.output)->format->is_text;
  Session s(f);
  if (!prepare_conversion(s)) {
    why.clear();
    return std::nullopt;
  }
  if (const auto written = s.pipeline().written_files(); !written.empty()) {
    why = fmt::format("{}: error: {} names one file, which each scene would replace\n", corpus_flags.recipe,
                      written[0].option);
    return std::nullopt;
  }
  auto options = f.given;  // of files in Python their contents count, not where they are
  std::erase_if(options, [](const auto& o) { return o.first == "python"; });
  std::string files;
  for (const auto& file : s.pipeline().files()) files += hash_of_file(file).value_or(ContentHash{}).hex() + "\n";
  work.hash = hash_of(program_identity() + "\n" + corpus_flags.format + "\n" + (f.load.strict ? "strict\n" : "") +
                      files + recipe_text(options, f.warnings, s.pipeline()));
  return work;
}

std::string run_recipe(const std::string& out) { return corpus_folder(out) + "/recipe.toml"; }

bool write_run_recipe(const CorpusWork& work, const CorpusPlan& plan) {
  Session s(work.flags);
  if (!prepare_conversion(s)) return false;
  auto options = work.flags.given;
  std::erase_if(options, [](const auto& o) { return o.first == "allow-path"; });
  auto folders = work.flags.load.allow_paths;
  folders.insert(folders.end(), plan.roots.begin(), plan.roots.end());
  options.emplace_back("allow-path", std::move(folders));
  return write_text_file(run_recipe(work.out), recipe_text(options, work.flags.warnings, s.pipeline()));
}

void do_job(const CorpusWork& work, const CorpusPlan& plan, const CorpusJob& job, bool may_replace, JournalLine& line) {
  const auto target = (fs::path(work.out) / job.output).string();
  std::error_code none;
  fs::create_directories(fs::path(target).parent_path(), none);
  line.input_hash = hash_of_file(job.input.path).value_or(ContentHash{});
  if (job.input.asset) {
    line.state = copy(job.input.path, target, may_replace, line.cause) ? JobState::made : JobState::failed;
  } else {
    Flags flags = work.flags;
    flags.inputs = {job.input.path};
    flags.output = target;
    flags.load.allow_paths = allowed_folders(work, plan, job);
    flags.save.own_folder = true;
    ConversionExtras extras;
    const auto named = work.text ? NamedUrls::all : NamedUrls::links;
    if (job.input.mirrored || !work.text)
      extras.last = [&](Scene& scene) {
        name_written_files(scene, plan, job, work.out, flags.load.allow_paths, named);
      };
    if (work.text && job.input.mirrored) {
      const auto& folder = plan.roots[job.input.root];
      flags.save.is_mirrored = [&, canonical = fs::weakly_canonical(folder, none)](const std::string& path) {
        return plan.by_path.contains(
            (fs::path(folder) / fs::path(path).lexically_relative(canonical)).lexically_normal());
      };
    }
    extras.may_replace = may_replace;
    extras.take = [&](const std::string& path) {
      if (auto name = name_below(work.out, path); name != job.output)
        line.companions.push_back({std::move(name), fs::file_size(path, none)});
    };
    convert(flags, extras, line);
  }
  if (is_made(line.state)) {
    line.output_bytes = fs::file_size(target, none);
    line.output_hash = hash_of_file(target).value_or(ContentHash{});
  }
}

DoneBefore::DoneBefore(const CorpusWork& work, const CorpusPlan& plan) : work_(work), plan_(plan) {
  const auto folder = corpus_folder(work.out);
  read_begun(folder, [&](std::string&& output) { unended_.insert(std::move(output)); });
  read_journals(folder, [&](JournalLine&& l) {
    if (l.state == JobState::failed || is_made(l.state)) unended_.erase(l.output);
    if (is_made(l.state)) made_.insert_or_assign(l.output, l.output_hash);
    known_[l.output] = {std::move(l.input),     l.work, l.input_hash, l.output_bytes, l.state, std::move(l.files),
                        std::move(l.companions)};
  });
}

bool DoneBefore::owns(const CorpusJob& job) const {
  if (unended_.contains(job.output)) return true;
  const auto made = made_.find(job.output);
  if (made == made_.end()) return false;
  const auto there = hash_of_file((fs::path(work_.out) / job.output).string());
  return !there || *there == made->second;
}

bool DoneBefore::is_moved(const CorpusJob& job) const {
  const auto at = known_.find(job.output);
  return at != known_.end() && at->second.input != job.input.path;
}

std::optional<JobState> DoneBefore::state_of(const CorpusJob& job) {
  const auto at = known_.find(job.output);
  if (at == known_.end() || at->second.work != work_.hash) return std::nullopt;
  const auto& known = at->second;
  std::error_code fault;
  if (is_made(known.state) && (fs::file_size(fs::path(work_.out) / job.output, fault) != known.output_bytes || fault))
    return std::nullopt;
  const auto is_there = [&](const CompanionFile& file) {
    return fs::file_size(fs::path(work_.out) / file.path, fault) == file.bytes && !fault;
  };
  if (!std::ranges::all_of(known.companions, is_there)) return std::nullopt;
  if (hash_of_file(job.input.path) != known.input_hash) return std::nullopt;
  for (const auto& f : known.files)
    if (!still_the_same(job, f)) return std::nullopt;
  return known.state;
}

/// Asks once more as the worker did: what was missing may have come, another file may now be nearer.
bool DoneBefore::still_the_same(const CorpusJob& job, const UsedFile& file) {
  std::string path = file.url;
  if (!file.referrer.empty()) {
    auto folders = allowed_folders(work_, plan_, job);
    folders.insert(folders.begin(), fs::path(job.input.path).parent_path().string());
    AllowedFiles files(folders);
    const auto found = find_url(files, file.url, file.referrer);
    path = found.state == AllowedFiles::found || found.state == AllowedFiles::repaired ? found.path : "";
  }
  return path.empty() ? file.path.empty() : !file.path.empty() && hash(path) == file.hash;
}

const ContentHash& DoneBefore::hash(const std::string& path) {
  auto [at, is_new] = hashes_.try_emplace(path);
  if (is_new) at->second = hash_of_file(path).value_or(ContentHash{});
  return at->second;
}

}  // namespace wrlkit

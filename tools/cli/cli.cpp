#include "tools/cli/cli.h"
#include "tools/cli/documents.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "base/text/amounts.h"
#include "tools/cli/options.h"
#include "tools/cli/outputs.h"
#include "tools/cli/python_passes.h"
#include "tools/cli/time_limit.h"
#include "tools/cli/verbs.h"
#include "tools/cli/words.h"

#ifndef WRLKIT_VERSION
#define WRLKIT_VERSION "unknown"
#endif

namespace wrlkit {
namespace {

using cli::find_verb;
using cli::Verb;
using cli::verbs;

// -Werror=NAME and -Wno-NAME look like bundled short flags to CLI11; they are taken out before.
std::vector<std::string> take_warning_flags(std::vector<std::string>& words) {
  std::vector<std::string> out;
  std::erase_if(words, [&](const std::string& w) {
    if (!w.starts_with("-W") || w.size() == 2) return false;
    out.push_back(w.substr(2));
    return true;
  });
  return out;
}

/// Address space that this program has, in bytes; 0 when the system does not say.
std::uint64_t own_memory() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// A corpus run has a time for each file, and divides the memory among its workers. False, which was printed, when the
/// memory would not be enough to begin with.
bool limit(const Verb& verb, const Flags& f) {
  const std::string_view name = verb.name;
  if (f.is_given("timeout") && name != "corpus-run") limit_time(seconds_of(f.timeout));
  if (f.memory.empty() || name.starts_with("corpus")) return true;
  constexpr std::uint64_t to_work = 16 << 20, mega = 1 << 20;
  const rlim_t bytes = size_of(f.memory);
  const auto needed = own_memory() + to_work;
  if (bytes < needed) {
    std::fprintf(stderr, "wrlkit: --memory %s: the program alone needs %lluM\n", f.memory.c_str(),
                 static_cast<unsigned long long>(needed / mega + 1));
    return false;
  }
  // By default malloc reserves 64 MB of addresses or more for each thread, which count although nothing is there.
  mallopt(M_ARENA_MAX, 1);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
  return true;
}

constexpr std::string_view program_help =
    "wrlkit: convert legacy virtual worlds (VRML97, VRML 1.0, X3D) to glTF, 3D Tiles, or better VRML";

std::vector<CLI::Option*> long_options(const CLI::App& app) {
  std::vector<CLI::Option*> out;
  for (auto* o : app.get_options([](const CLI::Option* o) { return !o->get_lnames().empty(); }))
    out.push_back(const_cast<CLI::Option*>(o));
  for (auto* group : app.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); }))
    for (auto* o : long_options(*group)) out.push_back(o);
  return out;
}

/// An option takes one argument, with commas in it where it is a list, so that the name of a file may follow.
void add_options(CLI::App& app, const Verb& verb, Flags& flags) {
  verb.flags(app, flags);
  cli::common(app, flags);
  for (auto* o : long_options(app)) o->allow_extra_args(false);
}

/// The options of one verb, as an application of their own.
std::unique_ptr<CLI::App> app_of(const Verb& verb, Flags& flags) {
  auto app = std::make_unique<CLI::App>(verb.help, verb.name);
  add_options(*app, verb, flags);
  return app;
}

bool is_flag(const CLI::Option& o) { return o.get_expected_min() == 0; }

/// What was given on the command line.
GivenOptions given_options(const CLI::App& verb) {
  GivenOptions out;
  for (auto* o : long_options(verb))
    if (o->count() > 0) out.emplace_back(o->get_lnames()[0], o->results());
  return out;
}

/// In our words where CLI11 lists the last one first.
std::string what_is_wrong(const CLI::ParseError& fault, const CLI::App& app) {
  if (dynamic_cast<const CLI::ExtrasError*>(&fault)) {
    constexpr std::size_t most = 3;
    auto more = app.remaining(true);
    const auto n_left_out = more.size() - std::min(most, more.size());
    more.resize(more.size() - n_left_out);
    return fmt::format("more arguments than it takes: '{}'{}", fmt::join(more, "' '"),
                       n_left_out > 0 ? fmt::format(" and {} more", n_left_out) : "");
  }
  const std::string what = fault.what();
  return what.substr(0, what.find_last_not_of(".\n") + 1);
}

std::string fault_text(const std::string& what, const std::vector<std::string>& words) {
  const Verb* verb = words.empty() ? nullptr : find_verb(words[0]);
  if (!verb) {
    const auto fault = program_option_fault(words);
    if (words.empty()) return "wrlkit: a verb or a file is required; see wrlkit --help\n";
    return fault.empty() ? "wrlkit: " + what + "; see wrlkit --help\n" : fault;
  }
  std::vector<std::string> options;
  Flags unused;
  const auto app = app_of(*verb, unused);
  for (const auto* o : long_options(*app)) {
    options.insert(options.end(), o->get_lnames().begin(), o->get_lnames().end());
    options.insert(options.end(), o->get_snames().begin(), o->get_snames().end());
  }
  const bool has_output = app->get_option_no_throw("OUT") != nullptr;
  std::string hint;
  if (app->get_option_no_throw("RECIPE") && what == "IN is required") hint = "; the recipe, RECIPE, comes before it";
  if (has_output && what.starts_with("more arguments")) hint = "; for many files, see wrlkit corpus run";
  return option_fault(verb->name, words, options, has_output, what + hint);
}

/// "corpus run" for "corpus-run".
std::string with_spoken_verbs(std::string help) {
  for (const Verb& v : verbs()) {
    const std::string name = v.name, spoken = spoken_verb(name);
    for (auto at = help.find(name); spoken != name && at != help.npos; at = help.find(name, at))
      help.replace(at, name.size(), spoken);
  }
  return help;
}

/// One parse. Flags that CLI11 cannot set are set by the caller.
int parse(std::vector<std::string> words, Flags& flags, const Verb*& chosen) {
  const auto given = words;
  std::ranges::reverse(words);
  CLI::App app(std::string(program_help), "wrlkit");
  app.set_version_flag("--version", std::string("wrlkit ") + WRLKIT_VERSION);
  app.require_subcommand(1);
  app.footer("\n'wrlkit IN' is short for 'wrlkit info IN', 'wrlkit IN OUT' for 'wrlkit convert IN OUT'.");
  app.failure_message(CLI::FailureMessage::simple);
  // Tables of all verbs take longer to make than a small file to convert.
  const Verb* const only = given.empty() ? nullptr : find_verb(given[0]);
  for (const Verb& v : verbs()) {
    if (only && only != &v) continue;
    auto* sub = app.add_subcommand(v.name, v.help);
    add_options(*sub, v, flags);
    sub->footer(std::string("-Werror=NAME and -Wno-NAME set the severity of one message (wrlkit explain NAME), -Werror "
                            "that of all warnings, -Werror=lost that of all that is lost.\n\nExample:\n  ") +
                v.example);
    sub->callback([&] { chosen = &v; });
  }
  try {
    app.parse(words);
  } catch (const CLI::CallForHelp&) {
    chosen = nullptr;
    std::fputs(with_spoken_verbs(app.help()).c_str(), stdout);
    return done;
  } catch (const CLI::CallForVersion& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    chosen = nullptr;
    std::fputs(fault_text(what_is_wrong(e, app), given).c_str(), stderr);
    return usage;
  }
  for (auto* sub : app.get_subcommands()) {
    flags.given = given_options(*sub);
    flags.can_replace = sub->get_option_no_throw("--in-place") != nullptr;
    if (auto* p = sub->get_option_no_throw("--pipeline")) flags.pipeline_given = p->count() > 0;
  }
  return done;
}

/// Verbs of one scene do not take a folder, and none takes what is in a network. False, which was printed.
bool takes_inputs(const Flags& flags, const Verb& verb) {
  namespace fs = std::filesystem;
  constexpr std::string_view of_one[] = {"convert", "optimize", "cat", "diff", "simplify", "compare-lod", "illuminate"};
  const bool is_of_one = std::ranges::find(of_one, std::string_view(verb.name)) != std::end(of_one);
  const auto fault = [&](const std::string& path) -> std::string_view {
    std::error_code none;
    if (path.find("://") != path.npos && !fs::exists(path, none))
      return "is a url; wrlkit reads local files, so give the path of one";
    if (is_of_one && path.find_first_of("*?") != path.npos && !fs::exists(path, none))
      return "is a pattern; wrlkit corpus run works on all scenes that match";
    if (is_of_one && path.starts_with('@') && !fs::exists(path, none))
      return "is a list; wrlkit corpus run works on all scenes in it";
    if (!is_of_one || !fs::is_directory(path, none)) return "";
    return verb.name == std::string_view("convert") || verb.name == std::string_view("optimize")
               ? "is a folder; wrlkit corpus run works on all scenes in folders"
               : "is a folder; name a scene in it";
  };
  for (const auto& path : flags.inputs)
    if (const std::string_view why = fault(path); !why.empty()) {
      complain(spoken_verb(verb.name), fmt::format("'{}' {}", path, why));
      return false;
    }
  return true;
}

/// Verbs that print what the program knows have nothing to report on.
void warn_of_idle_report(const Flags& flags, const Verb& verb) {
  constexpr std::string_view of_program[] = {"passes", "formats", "explain", "docs", "completion", "manual"};
  if (flags.report.empty() || flags.quiet) return;
  if (std::ranges::find(of_program, std::string_view(verb.name)) == std::end(of_program)) return;
  fmt::print(stderr, "wrlkit {}: --report has no effect here; see --json\n", verb.name);
}

void warn_of_missing_folders(const Flags& flags) {
  std::error_code none;
  for (const auto& folder : flags.load.allow_paths)
    if (!flags.quiet && !std::filesystem::is_directory(folder, none))
      std::fprintf(stderr, "wrlkit: --allow-path: there is no folder '%s'\n", folder.c_str());
}

/// Standard output takes one of these: an output, the JSON, the report. False, which was printed.
bool can_share_standard_output(const Flags& flags, const Verb& verb) {
  const bool prints = *verb.no_json && (flags.output.empty() || flags.output == "-");
  const bool is_output = prints || flags.output == "-";
  const auto refuse = [&](std::string_view option, std::string_view why) {
    fmt::print(stderr, "wrlkit {}: {}: {}\n", spoken_verb(verb.name), option, why);
    return false;
  };
  const bool prints_text = flags.print_pipeline || flags.print_recipe || flags.print_profile;
  if (flags.json && prints_text) return refuse("--json", "what is printed then is not JSON");
  if (flags.json && flags.serve) return refuse("--json", "--serve prints the address of the page; it has no result");
  if (flags.report == "-" && (flags.json || is_output))
    return refuse("--report -", "something else goes to standard output; name a file for the report");
  if (!flags.json || !is_output) return true;
  return refuse("--json", prints ? verb.no_json
                                 : "the output itself goes to standard output; name a file for it, or use --report "
                                   "FILE.json");
}

std::vector<std::string> words_of(const GivenOptions& options) {
  std::vector<std::string> words;
  for (const auto& [name, values] : options)
    for (const auto& v : values)
      if (v.empty())
        words.insert(words.end(), {"--" + name, ""});  // behind "=" CLI11 takes no value for a missing one
      else
        words.push_back("--" + name + "=" + v);
  return words;
}

/// The command line with what its recipe says, as far as it does not say that itself. False, with a message, when the
/// recipe is none.
bool add_recipe(const Flags& flags, const Verb& verb, std::vector<std::string>& words,
                std::vector<std::string>& warnings) {
  std::string why;
  auto recipe = read_recipe(flags.recipe, why);
  if (!recipe) {
    std::fputs(why.c_str(), stderr);
    return false;
  }
  if (!recipe->python.empty()) recipe->options.emplace_back("python", recipe->python);
  if (recipe->pipeline) recipe->options.emplace_back("pipeline", std::vector{*recipe->pipeline});
  Flags unused;
  const auto app = app_of(verb, unused);
  std::erase_if(recipe->options, [&](const auto& o) {
    const bool is_of_corpus = o.first == "format" && !std::string_view(verb.name).starts_with("corpus");
    return !app->get_option_no_throw("--" + o.first) || is_of_corpus || flags.is_given(o.first);
  });
  const auto added = words_of(recipe->options);
  words.insert(std::ranges::find(words, verb.name) + 1, added.begin(), added.end());
  warnings.insert(warnings.begin(), recipe->warnings.begin(), recipe->warnings.end());
  return true;
}

}  // namespace

std::string_view program_version() { return WRLKIT_VERSION; }

std::vector<OptionHelp> options_of(std::string_view verb) {
  Flags unused;
  const auto app = app_of(*find_verb(verb), unused);
  std::vector<OptionHelp> out;
  for (auto* o : long_options(*app))
    out.push_back({.name = o->get_lnames()[0],
                   .type = is_flag(*o) ? std::string(flag_type) : o->get_type_name(),
                   .help = o->get_description(),
                   .letter = o->get_snames().empty() ? std::string() : o->get_snames()[0]});
  return out;
}

bool check_option(std::string_view verb, std::string_view option, const std::vector<std::string>& values,
                  std::string& why) {
  Flags unused;
  const auto app = app_of(*find_verb(verb), unused);
  auto* o = app->get_option("--" + std::string(option));
  try {
    for (const auto& v : values) o->add_result(v);
    o->run_callback();
    return true;
  } catch (const CLI::Error& e) {
    why = in_our_words(e.what());
    return false;
  }
}

Flags conversion_flags(const Recipe& recipe) {
  const Verb& convert = *find_verb("convert");
  Flags flags;
  const auto app = app_of(convert, flags);
  auto options = recipe.options;
  std::erase_if(options, [&](const auto& o) { return !app->get_option_no_throw("--" + o.first); });
  if (recipe.pipeline) options.emplace_back("pipeline", std::vector{*recipe.pipeline});
  if (!recipe.python.empty()) options.emplace_back("python", recipe.python);
  auto words = words_of(options);
  for (const char* word : {"--", "IN", "OUT"}) words.emplace_back(word);
  std::ranges::reverse(words);
  app->parse(words);
  flags.given = given_options(*app);
  flags.pipeline_given = recipe.pipeline.has_value();
  flags.warnings = recipe.warnings;
  return flags;
}

int run_command_line(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const auto warnings = take_warning_flags(words);
  if (const auto ended = put_verb_first(words)) return *ended;
  Flags flags;
  const Verb* chosen = nullptr;
  int code = parse(words, flags, chosen);
  std::vector<std::string> of_recipe;
  std::string why;
  if (chosen && !load_python_passes(flags.python, why)) {
    std::fprintf(stderr, "wrlkit: --python: %s\n", why.c_str());
    return usage;
  }
  if (chosen && !flags.recipe.empty()) {
    if (!add_recipe(flags, *chosen, words, of_recipe)) return usage;
    flags = {};
    code = parse(words, flags, chosen);
  }
  if (!chosen) return code;
  flags.warnings = of_recipe;
  flags.warnings.insert(flags.warnings.end(), warnings.begin(), warnings.end());
  if (!takes_inputs(flags, *chosen)) {
    print_failure(flags, nothing);
    return nothing;
  }
  warn_of_missing_folders(flags);
  warn_of_idle_report(flags, *chosen);
  if (!can_share_standard_output(flags, *chosen)) return usage;
  if (!check_outputs(flags, chosen->endings, chosen->makes)) return usage;
  if (!limit(*chosen, flags)) return usage;
  code = chosen->run(flags);
  if (code == nothing) print_failure(flags, code);
  return code;
}

}  // namespace wrlkit

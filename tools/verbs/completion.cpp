// What completes commands in a shell, from the table of verbs and their options.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "tools/cli/cli.h"
#include "tools/cli/verbs.h"
#include "tools/cli/words.h"

namespace wrlkit {
namespace {

/// A verb as its words, with its options: "corpus run" has two words, and "corpus-run" is the name of its row.
struct SpokenVerb {
  std::string name, first, second;
  std::string_view help;
  std::vector<OptionHelp> options;
};

std::vector<SpokenVerb> spoken_verbs() {
  std::vector<SpokenVerb> out;
  for (const auto& v : cli::verbs()) {
    const std::string words = spoken_verb(v.name);
    const auto blank = words.find(' ');
    out.push_back({v.name, words.substr(0, blank), blank == words.npos ? "" : words.substr(blank + 1), v.help,
                   options_of(v.name)});
  }
  return out;
}

bool is_flag(const OptionHelp& o) { return o.type == flag_type; }

/// The values of "TEXT:{none,mesh}", with blanks between them; empty when it is not a choice.
std::string values_of(const OptionHelp& o) {
  const auto begin = o.type.find('{'), end = o.type.find('}');
  if (begin == o.type.npos || end == o.type.npos) return {};
  std::string values = o.type.substr(begin + 1, end - begin - 1);
  std::ranges::replace(values, ',', ' ');
  return values;
}

/// Between single quotes, in all three shells (fish has no '"'"', but knows \').
std::string quoted(std::string_view text, std::string_view quote) {
  std::string out = "'";
  for (char c : text)
    if (c == '\'')
      out += quote;
    else
      out += c;
  return out + "'";
}

/// The first words, each once, in the order of the table.
std::vector<std::string> first_words(const std::vector<SpokenVerb>& verbs) {
  std::vector<std::string> out;
  for (const auto& v : verbs)
    if (std::ranges::find(out, v.first) == out.end()) out.push_back(v.first);
  return out;
}

std::string second_words(const std::vector<SpokenVerb>& verbs, std::string_view first) {
  std::string out;
  for (const auto& v : verbs)
    if (v.first == first && !v.second.empty()) out += (out.empty() ? "" : " ") + v.second;
  return out;
}

std::string bash_values(const SpokenVerb& v) {
  std::string out;
  for (const auto& o : v.options) {
    const std::string values = values_of(o);
    const std::string what = !values.empty() ? fmt::format("-W '{}'", values) : o.type == "DIR" ? "-d" : "-f";
    if (!is_flag(o)) out += fmt::format("    '{} --{}') kind=\"{}\" ;;\n", v.name, o.name, what);
  }
  return out;
}

std::string bash_text() {
  const auto verbs = spoken_verbs();
  std::string options, values, twos;
  for (const auto& v : verbs) {
    options += fmt::format("    {}) words='", v.name);
    for (const auto& o : v.options) options += fmt::format("--{} ", o.name);
    options += "--help' ;;\n";
    values += bash_values(v);
  }
  const auto firsts = first_words(verbs);
  for (const auto& first : firsts)
    if (const auto second = second_words(verbs, first); !second.empty())
      twos += fmt::format(
          "  if [ \"$verb\" = {0} ]; then\n    if [ \"$COMP_CWORD\" -eq 2 ]; then COMPREPLY=($(compgen -W '{1}' -- "
          "\"$now\")); return; fi\n    verb={0}-${{COMP_WORDS[2]}}\n  fi\n",
          first, second);
  return fmt::format(
      "# bash completion of wrlkit; made by wrlkit completion bash.\n"
      "_wrlkit() {{\n"
      "  local now=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} verb=${{COMP_WORDS[1]}} words='' "
      "kind='-f'\n"
      "  COMPREPLY=()\n"
      "  compopt -o filenames 2>/dev/null\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then COMPREPLY=($(compgen -W 'help {}' -f -- \"$now\")); return; fi\n"
      "{}"
      "  case $verb in\n{}  esac\n"
      "  case $now in -*) COMPREPLY=($(compgen -W \"$words\" -- \"$now\")); return ;; esac\n"
      "  case \"$verb $before\" in\n{}  esac\n"
      "  COMPREPLY=($(eval compgen \"$kind\" -- '\"$now\"'))\n"
      "}}\n"
      "complete -F _wrlkit wrlkit\n",
      fmt::join(firsts, " "), twos, options, values);
}

/// A description in an _arguments specification: brackets and colons have a meaning there.
std::string zsh_help(std::string_view help) {
  std::string out;
  for (char c : help) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_option(const OptionHelp& o) {
  const std::string values = values_of(o);
  const std::string what = is_flag(o)         ? ""
                           : !values.empty()  ? fmt::format(":value:({})", values)
                           : o.type == "DIR"  ? ":folder:_files -/"
                           : o.type == "FILE" ? ":file:_files"
                                              : ":value:";
  return quoted(fmt::format("--{}[{}]{}", o.name, zsh_help(o.help), what), "'\\''");
}

std::string zsh_text() {
  const auto verbs = spoken_verbs();
  std::string out =
      "#compdef wrlkit\n# zsh completion of wrlkit; made by wrlkit completion zsh.\n_wrlkit() {\n"
      "  local verb=$words[2]\n  if (( CURRENT == 2 )); then\n    local -a verbs=(\n";
  for (const auto& first : first_words(verbs)) {
    const auto v = std::ranges::find(verbs, first, &SpokenVerb::first);
    out += fmt::format("      {}\n",
                       quoted(fmt::format("{}:{}", first, v->second.empty() ? v->help : "many files"), "'\\''"));
  }
  out += "    )\n    _describe verb verbs\n    _files\n    return\n  fi\n";
  for (const auto& first : first_words(verbs))
    if (const auto second = second_words(verbs, first); !second.empty())
      out += fmt::format(
          "  if [[ $verb = {0} ]]; then\n    if (( CURRENT == 3 )); then\n      compadd {1}\n      return\n    fi\n    "
          "verb={0}-$words[3]\n    shift words\n    (( CURRENT-- ))\n  fi\n",
          first, second);
  out += "  shift words\n  (( CURRENT-- ))\n  case $verb in\n";
  for (const auto& v : verbs) {
    out += fmt::format("    {})\n      _arguments", v.name);
    for (const auto& o : v.options) out += " \\\n        " + zsh_option(o);
    out += " \\\n        '*:file:_files'\n      ;;\n";
  }
  return out + "  esac\n}\n_wrlkit \"$@\"\n";
}

std::string fish_text() {
  const auto verbs = spoken_verbs();
  std::string out = "# fish completion of wrlkit; made by wrlkit completion fish.\n";
  for (const auto& first : first_words(verbs)) {
    const auto v = std::ranges::find(verbs, first, &SpokenVerb::first);
    out += fmt::format("complete -c wrlkit -n __fish_use_subcommand -a {} -d {}\n", first,
                       quoted(v->second.empty() ? v->help : "many files", "\\'"));
    if (const auto second = second_words(verbs, first); !second.empty())
      out += fmt::format("complete -c wrlkit -n '__fish_seen_subcommand_from {}' -a '{}'\n", first, second);
  }
  for (const auto& v : verbs)
    for (const auto& o : v.options) {
      const std::string seen =
          v.second.empty()
              ? fmt::format("'__fish_seen_subcommand_from {}'", v.first)
              : fmt::format("'__fish_seen_subcommand_from {}; and __fish_seen_subcommand_from {}'", v.first, v.second);
      const std::string values = values_of(o);
      out += fmt::format("complete -c wrlkit -n {} -l {}", seen, o.name);
      if (o.letter.size() == 1) out += " -s " + o.letter;
      if (!values.empty())
        out += fmt::format(" -x -a '{}'", values);
      else if (!is_flag(o))
        out += " -r";
      out += fmt::format(" -d {}\n", quoted(o.help, "\\'"));
    }
  return out;
}

}  // namespace

int run_completion(const Flags& flags) {
  const std::string text = flags.name == "bash" ? bash_text() : flags.name == "zsh" ? zsh_text() : fish_text();
  std::fputs(text.c_str(), stdout);
  return done;
}

}  // namespace wrlkit

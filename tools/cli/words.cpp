#include "tools/cli/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "base/math/digits.h"
#include "base/text/nearest_name.h"
#include "convert/formats.h"
#include "passes/pipeline/pipeline.h"
#include "tools/cli/cli.h"
#include "tools/cli/flags.h"
#include "tools/cli/recipe.h"
#include "tools/cli/verbs.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;
using cli::find_verb;
using cli::Verb;
using cli::verbs;

constexpr std::string_view corpus = "corpus";

int corpus_help(bool asked) {
  std::string text = "wrlkit corpus: many files at once\n\n";
  for (const Verb& v : verbs())
    if (std::string_view(v.name).starts_with("corpus-"))
      text += fmt::format("  wrlkit {}\n      {}\n", spoken_verb(v.name), v.help);
  text += "\n'wrlkit corpus run --help' lists the options of one.\n";
  std::fputs(text.c_str(), asked ? stdout : stderr);
  return asked ? done : usage;
}

int say(const std::string& message) {
  fmt::print(stderr, "wrlkit: {}\n", message);
  return usage;
}

int no_such_verb(const std::string& word) {
  NearestName nearest(word);
  for (const Verb& v : verbs()) nearest.consider(v.name);
  nearest.consider(corpus);
  nearest.consider("help");
  if (!ending_of(word, scene_endings()).empty()) return say(fmt::format("there is no file '{}'", word));
  const bool near = !nearest.best().empty();
  if (!near && word.find_first_of("./") != word.npos)
    return say(fmt::format("there is no file '{}', and no such verb; see wrlkit --help", word));
  if (!near && find_pass(word)) return say(fmt::format("'{}' is a pass, not a verb; see wrlkit passes {}", word, word));
  return say(fmt::format("there is no verb '{}'{}{}", spoken_verb(word),
                         near ? fmt::format("; did you mean '{}'?", spoken_verb(std::string(nearest.best()))) : ";",
                         near ? "" : " see wrlkit --help"));
}

bool is_file(const std::string& word) {
  std::error_code none;
  return word == "-" || fs::exists(word, none);
}

/// A file, or two, without a verb.
std::optional<int> verb_of_files(std::vector<std::string>& words) {
  const auto is_output = [](const std::string& word) { return !word.starts_with('-') && output_of(word).has_value(); };
  const auto output = std::find_if(words.begin() + 1, words.end(), is_output);
  if (output == words.end()) {
    if (words.size() > 1 && !words[1].starts_with('-') && !is_file(words[1]) && words[1].find('.') != std::string::npos)
      return say(fmt::format("there is no file '{}', and no format has its ending; see wrlkit formats", words[1]));
    words.insert(words.begin(), "info");
    return std::nullopt;
  }
  std::error_code none;
  if (fs::exists(*output, none))
    return say(fmt::format("'{}' exists; 'wrlkit convert {} {}' replaces it, 'wrlkit info' says what files are",
                           *output, words[0], *output));
  words.insert(words.begin(), "convert");
  return std::nullopt;
}

/// 'corpus run' in quotes, where a verb may stand, is two words.
void split_corpus_verb(std::vector<std::string>& words) {
  const std::string front = std::string(corpus) + ' ';
  const std::size_t at = words[0] == "help" ? 1 : 0;
  if (at >= words.size() || !words[at].starts_with(front)) return;
  const std::string second = words[at].substr(front.size());
  if (!find_verb(std::string(corpus) + '-' + second)) return;
  words[at] = corpus;
  words.insert(words.begin() + static_cast<std::ptrdiff_t>(at) + 1, second);
}

/// What stands between two words of a text; nothing when it has not both, in this order.
std::optional<std::string> between(std::string_view text, std::string_view from, std::string_view to) {
  const auto begin = text.find(from);
  if (begin == text.npos) return std::nullopt;
  text.remove_prefix(begin + from.size());
  const auto end = to.empty() ? text.size() : text.find(to);
  return end == text.npos ? std::nullopt : std::optional(std::string(text.substr(0, end)));
}

/// "0.1" of "0.100000".
std::string plain_number(const std::string& text) {
  double value = 0;
  if (!read_number(std::string_view(text), value)) return text;
  return std::trunc(value) == value ? fmt::format("{:.0f}", value) : shortest_text(value);
}

/// An option of convert, which `corpus` has not: it belongs to the recipe.
std::string recipe_hint(std::string_view verb, std::string_view option) {
  if (!verb.starts_with("corpus-")) return {};
  const auto section = recipe_section(option);
  const auto options = options_of("convert");
  if (section.empty() || std::ranges::find(options, option, &OptionHelp::name) == options.end()) return {};
  return fmt::format("; it belongs to the recipe: {} in section [{}]", option, section);
}

/// "-o", which many programs have, where this verb takes the output behind the input.
std::string output_hint(const std::string& verb, const std::vector<std::string>& words, bool takes_output) {
  const bool has = std::ranges::any_of(words, [](const auto& w) { return w == "-o" || w.starts_with("--output"); });
  const Verb* found = find_verb(verb);
  const std::string_view example = found ? found->example : "";
  return has && takes_output ? fmt::format("{} writes to the name behind the input, without -o: {}", verb,
                                           example.substr(0, example.find('\n')))
                             : std::string();
}

constexpr std::size_t most_meant = 3;  // options that begin with a letter

/// The first option of one letter that is not among `options`; empty when there is none.
std::string unknown_letter(const std::vector<std::string>& words, const std::vector<std::string>& options) {
  for (const auto& word : words) {
    if (word.size() < 2 || word[0] != '-' || !std::isalpha(static_cast<unsigned char>(word[1])) || word[1] == 'W')
      continue;
    if (std::ranges::find(options, word.substr(1, 1)) == options.end()) return word.substr(0, 2);
  }
  return {};
}

}  // namespace

std::string in_our_words(const std::string& what) {
  const auto needed = between(what, ": At least ", " required but received ");
  const auto given = between(what, " required but received ", "");
  if (needed && given) {
    const auto option = what.substr(0, what.find(": At least "));
    return option == "IN" ? "IN and OUT are required"
                          : fmt::format("{}: {} values are needed, not {}", option, *needed, *given);
  }
  if (const auto option = between(what, "Could not convert: ", " = "), text = between(what, " = ", "");
      option && text) {
    const bool is_list = text->find(' ') != text->npos && text->find(',') == text->npos;
    return fmt::format("{}: '{}' is not a valid value{}", *option, *text,
                       is_list ? "; commas separate the values of a list: 1,2,3" : "");
  }
  if (const auto option = between(what, "", ": At Most 1 required but received "))
    return *option + ": only one value can be given" +
           (option->ends_with("pipeline") ? "; commas separate passes: -p weld,lod" : "");
  if (const auto option = between(what, "", ": 1 required "); option && what.ends_with(" missing"))
    return *option + ": a value is missing";
  const auto value = between(what, "Value ", " not in range "), least = between(what, " not in range ", " to "),
             most = between(what, " to ", "");
  double number = 0;
  if (value && !read_number(std::string_view(*value), number))
    return fmt::format("{}'{}' is not a number", what.substr(0, what.find("Value ")), *value);
  if (value && read_number(std::string_view(*value), number) && number >= 1 &&
      value->find_first_of(".eE") != value->npos)
    return fmt::format("{}{} is not a whole number", what.substr(0, what.find("Value ")), *value);
  if (value && least && most)
    return fmt::format("{}{} is not in the range {} to {}", what.substr(0, what.find("Value ")), *value,
                       plain_number(*least), plain_number(*most));
  return what;
}

std::string spoken_verb(const std::string& verb) {
  return verb.starts_with("corpus-") ? "corpus " + verb.substr(7) : verb;
}

std::string program_option_fault(const std::vector<std::string>& words) {
  if (words.empty() || !words[0].starts_with('-')) return {};
  NearestName nearest(words[0]);
  for (const auto* option : {"--help", "--version"}) nearest.consider(option);
  const auto question = nearest.question();
  return fmt::format("wrlkit: there is no option '{}' without a verb{}\n", words[0],
                     question.empty() ? "; options stand behind a verb; see wrlkit --help" : question);
}

std::optional<int> put_verb_first(std::vector<std::string>& words) {
  if (words.empty()) return std::nullopt;
  split_corpus_verb(words);
  if (words[0] == "version" || words[0] == "-V") words[0] = "--version";
  const bool asks_help = words[0] == "help";
  if (asks_help) words.erase(words.begin());
  if (words.size() > 1 && words[0] == corpus && !words[1].starts_with('-')) {
    words[0] += "-" + words[1];
    words.erase(words.begin() + 1);
  }
  if (!words.empty() && words[0] == corpus)
    return corpus_help(asks_help || (words.size() > 1 && (words[1] == "--help" || words[1] == "-h")));
  if (asks_help) {
    words.resize(std::min<std::size_t>(words.size(), 1));
    words.emplace_back("--help");
  }
  if ((words[0].starts_with('-') && words[0] != "-") || find_verb(words[0])) return std::nullopt;
  return is_file(words[0]) ? verb_of_files(words) : std::optional(no_such_verb(words[0]));
}

std::string option_fault(const std::string& verb, const std::vector<std::string>& words,
                         const std::vector<std::string>& options, bool takes_output, const std::string& what) {
  const auto name = "wrlkit " + spoken_verb(verb);
  if (std::ranges::find(options, "output") == options.end())
    if (const auto hint = output_hint(verb, words, takes_output); !hint.empty()) return name + ": " + hint + '\n';
  for (const auto& word : words) {
    if (!word.starts_with("--") || word.size() == 2) continue;
    const auto option = word.substr(2, std::min(word.find('='), word.size()) - 2);
    if (option == "help" || std::ranges::find(options, option) != options.end()) continue;
    if (const auto hint = recipe_hint(verb, option); !hint.empty())
      return fmt::format("{}: there is no option '--{}'{}\n", name, option, hint);
    NearestName nearest(option);
    for (const auto& o : options) nearest.consider(o);
    const auto meant = nearest.best().empty() ? fmt::format("; see {} --help", name)
                                              : fmt::format("; did you mean '--{}'?", nearest.best());
    return fmt::format("{}: there is no option '--{}'{}\n", name, option, meant);
  }
  if (const auto letter = unknown_letter(words, options); !letter.empty()) {
    std::vector<std::string> same;
    for (const auto& o : options)
      if (o.size() > 1 && o[0] == letter[1]) same.push_back("'--" + o + "'");
    const bool is_few = !same.empty() && same.size() <= most_meant;
    const auto meant =
        is_few ? fmt::format("; did you mean {}?", fmt::join(same, " or ")) : fmt::format("; see {} --help", name);
    return fmt::format("{}: there is no option '{}'{}\n", name, letter, meant);
  }
  const auto text = in_our_words(what);
  return fmt::format("{}: {}{} see {} --help\n", name, text, text.ends_with('?') ? "" : ";", name);
}

}  // namespace wrlkit

#include "tools/verbs/message_help.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace wrlkit {
namespace {

struct Help {
  Diag id;
  std::string_view example, why, what_to_do;
};

constexpr Help helps[] = {
#define HELP(name, example, why, what_to_do) {Diag::name, example, why, what_to_do},
#include "tools/verbs/message_help.def"
#undef HELP
};

std::vector<std::string> places_of(std::string_view example) {
  std::vector<std::string> out;
  while (true) {
    const auto bar = example.find('|');
    out.emplace_back(example.substr(0, bar));
    if (bar == example.npos) return out;
    example.remove_prefix(bar + 1);
  }
}

std::string text_with(const DiagInfo& diag, std::vector<std::string> places) {
  return Message{diag.id, diag.severity, {}, std::move(places)}.text();
}

std::string_view meaning(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "part of the result is missing or wrong; the exit code is 1, or 3 when nothing could be made";
    case Severity::warning:
      return "something was doubtful, and was repaired or passed over as the message says";
    case Severity::lost:
      return "the format that is written cannot express it";
    default:
      return "for information";
  }
}

}  // namespace

MessageExplanation message_explanation(Diag id) {
  const auto help = std::ranges::find(helps, id, &Help::id);
  constexpr std::size_t most_places = 8;
  if (help == std::end(helps)) return {text_with(info(id), std::vector<std::string>(most_places, "...")), {}, {}};
  return {text_with(info(id), places_of(help->example)), help->why, help->what_to_do};
}

std::string message_help(Diag id) {
  const auto [severity, name] = std::pair(to_string(info(id).severity), info(id).name);
  const auto help = message_explanation(id);
  auto out = fmt::format("{} [{}]: {}\n", severity, name, help.example);
  if (!help.why.empty()) out += fmt::format("  why: {}\n  what to do: {}\n", help.why, help.what_to_do);
  return out + fmt::format("  {}: {}\n", severity, meaning(info(id).severity));
}

}  // namespace wrlkit

// Pass `switch`: its documentation is in its options.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct SwitchOptions {
  static constexpr std::string_view doc =
      R"(Chooses what Switch nodes show, by their names.

    before   DEF SW_BEAMS Switch { whichChoice -1 choice [ Group { } Shape { ... } ] }
    after    DEF SW_BEAMS Switch { whichChoice 1 choice [ Group { } Shape { ... } ] }      # switch{SW_*=1}

`NAME=N` shows child N of every Switch of that name; N is -1 for none. A `*` in the name stands for any characters, a
`?` for one; of several names that fit, the last one counts. `all` goes on to every Switch that shows nothing: its
children become those of a Group, which it shows. What `--show-all` puts in
front of a pipeline, or sets in the `switch` that it has. Steel models often hide all of their parts this way until a
script switches them on.

Cost: O(nodes).)";
  static constexpr StatisticInfo statistics[] = {{"switch.changed", "Switches that show something else"}};

  bool all = false;
  std::vector<std::pair<std::string, int>> choices;  // by name or pattern

  void fields(auto&& f) {
    f("all", all, "Switches that are off show all their children");
    for (auto& [name, which] : choices) f(name, which, "child that a Switch of this name shows", at_least(-1));
  }
  /// An option of another name is the name of Switches.
  void add_field(std::string_view name) {
    for (const auto& choice : choices)
      if (choice.first == name) return;
    choices.emplace_back(name, -1);
  }
};
/// Whether a Switch has a name that fits the pattern.
bool has_switch_named(const Scene&, const std::string& pattern);
Outcome switch_on(Scene&, const SwitchOptions&, PassContext&);

}  // namespace wrlkit

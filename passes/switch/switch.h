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
      R"(
Sets which child a Switch shows. Switches are chosen by name.

    before   DEF SW_BEAMS Switch { whichChoice -1 choice [ Group { } Shape { ... } ] }
    after    DEF SW_BEAMS Switch { whichChoice 1 choice [ Group { } Shape { ... } ] }      # switch{SW_*=1}

`NAME=N` shows child N of every Switch of that name; -1 shows none. In a name, `*` stands for any characters and `?` for
one. If several names match a Switch, the last one counts.

`all` is for every Switch that still shows nothing: its children are moved into a Group, which the Switch then shows.
`--show-all` adds this pass, or sets `all` if the pass is already there. It runs after Inlines and prototypes have been
expanded, where that is done at all. Steel models often hide all their parts in Switches until a Script turns them on.

Cost: O(nodes).)";
  static constexpr StatisticInfo statistics[] = {{"switch.changed", "Switches that show something else than before"}};

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

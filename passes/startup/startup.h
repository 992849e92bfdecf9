// Pass `startup`: its documentation stands in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct StartupOptions {
  static constexpr std::string_view doc = R"(
Runs `initialize` of every Script, as a browser does when it loads the scene.

    before   DEF S Script { eventOut SFInt32 which url "javascript: function initialize() { which = 0; }" }
             DEF PARTS Switch { whichChoice -1 choice [ ... ] }     ROUTE S.which TO PARTS.set_whichChoice
    after    DEF PARTS Switch { whichChoice 0 choice [ ... ] }

Scripts may be ECMAScript or VRMLScript, in the url itself or in a .js file that may be read. The types are those of
ISO/IEC 14772-1, Annex C. Scripts run one after the other, in the order of the file. Their events follow ROUTEs, also to
other Scripts; each eventOut sends once. With directOutput TRUE, a Script may set fields of other nodes. Every node that
changes is reported.

The Scripts themselves do not change, and a browser will run them again. Time stands still (2000-01-01), and Math.random
gives the same numbers in every run. Only this first moment is computed: no clock runs, no sensor fires, no interpolator
moves, no file is loaded.

The programs run in a process of their own, without files or network, with 2 s of CPU time and 64 MiB of memory for all
Scripts together. If they need more, the scene does not change, and this is reported. The pass needs `expand`: `-p
startup` places it after that pass. `--run-startup` does the same. It requires a build with Duktape.

Cost: that of the Scripts, plus O(nodes) if there is one.)";
  static constexpr StatisticInfo statistics[] = {{"startup.scripts", "Scripts whose initialize was called"},
                                                 {"startup.events", "events sent along ROUTEs"},
                                                 {"startup.nodes", "nodes whose values changed"}};

  void fields(auto&&) {}
};
Outcome startup(Scene&, const StartupOptions&, PassContext&);

}  // namespace wrlkit

// Pass `startup`: its documentation stands in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct StartupOptions {
  static constexpr std::string_view doc = R"(
Runs what Scripts do when a browser loads the world: their function `initialize`.

    before   DEF S Script { eventOut SFInt32 which url "javascript: function initialize() { which = 0; }" }
             DEF PARTS Switch { whichChoice -1 choice [ ... ] }     ROUTE S.which TO PARTS.set_whichChoice
    after    DEF PARTS Switch { whichChoice 0 choice [ ... ] }

Scripts in ECMAScript and VRMLScript run, with the types of ISO/IEC 14772-1 Annex C: in the url, or in a file .js that
may be read. One after the other, in the order of the file, each with the events that it sends: they go along ROUTEs, to
other Scripts as well; an eventOut sends once. Fields of other nodes are set with directOutput TRUE. Each node that has
changed is reported. The Scripts themselves stay as they are: fields of their own do not change, and a browser runs them
again. Time stands still (2000-01-01), Math.random repeats itself. Nothing that needs more than this first instant
happens: no clock runs, no sensor senses, no interpolator is followed, no world is loaded.

The programs run in a process of their own, which has no files and no network, 2 s of processor time and 64 MiB of
memory for all of them. Where they need more, the world stays as it was, which is reported. It runs as soon as the world
is gathered: `-p startup` puts it behind `expand`, which it needs. `--run-startup` is the same. Needs Duktape when wrlkit
is built.

Cost: that of the Scripts, and O(nodes) where there is one.)";
  static constexpr StatisticInfo statistics[] = {{"startup.scripts", "Scripts whose initialize was called"},
                                                 {"startup.events", "events that were sent along ROUTEs"},
                                                 {"startup.nodes", "nodes with other values than before"}};

  void fields(auto&&) {}
};
Outcome startup(Scene&, const StartupOptions&, PassContext&);

}  // namespace wrlkit

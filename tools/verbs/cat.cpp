// wrlkit cat: the VRML97 writer on standard output.
#include <fmt/format.h>

#include "tools/cli/session.h"
#include "tools/vrml_file.h"

namespace wrlkit {

int run_cat(const Flags& flags) {
  Session s(flags);
  if (!s.good() || !s.choose_pipeline(vrml_pipeline(flags))) return usage;
  if (flags.print_pipeline) {
    fmt::print("{}\n", s.pipeline().text());
    return done;
  }
  if (!s.read(flags.inputs[0]) || !s.pipeline().run(s.world().scene, s.context(), s.pipeline_options()))
    return s.end(false);
  return s.end(write_vrml_file(s, s.world().scene, flags.output.empty() ? "-" : flags.output, flags.gzip));
}

}  // namespace wrlkit

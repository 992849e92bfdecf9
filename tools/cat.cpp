// wrlkit cat: the VRML97 writer on standard output.
#include <fmt/format.h>

#include "tools/session.h"
#include "writers/output.h"
#include "writers/vrml.h"

namespace wrlkit {

int run_cat(const Flags& flags) {
  Session s(flags);
  if (!s.good() || !s.choose_pipeline(flags.pipeline == "none" ? "none" : "vrml")) return usage;
  if (flags.print_pipeline) return fmt::print("{}\n", s.pipeline().text()), done;
  if (!s.read(flags.inputs[0]) || !s.pipeline().run(s.world().scene, s.context(), s.pipeline_options())) return s.end(false);
  auto file = OutputFile::open(flags.output.empty() ? "-" : flags.output, {.gzip = flags.gzip}, s.diag());
  if (!file) return s.end(false);
  write_vrml(s.world().scene, {.precision = flags.precision, .file = flags.output == "-" ? "" : flags.output}, file->sink(), s.diag());
  return s.end(file->commit(s.diag()));
}

}  // namespace wrlkit

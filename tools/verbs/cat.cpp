// wrlkit cat: the VRML97 writer on standard output.
#include "tools/verbs/convert.h"

namespace wrlkit {

int run_cat(const Flags& flags) {
  Session s(flags);
  const auto options = save_options(flags);
  auto to = *output_of(".wrl", options);
  to.path = flags.output.empty() ? "-" : flags.output;
  if (!s.good() || !s.choose_pipeline(to.format->pipeline(options))) return usage;
  if (s.printed_pipeline()) return done;
  const auto saved = s.document().read(flags.inputs[0])
                         ? write_document(s.document(), s.pipeline(), to, options, {s.pipeline_options()})
                         : Saved{};
  if (saved) warn_of_files_outside(s, to, options);
  if (flags.json) s.print_json(facts_json(s, to, saved));
  return s.end(static_cast<bool>(saved));
}

}  // namespace wrlkit

// wrlkit convert: read, run the pipeline, write. The end of the output's name decides the format.
#include "tools/verbs/convert.h"

#include <fmt/format.h>

#include <algorithm>

#include "convert/convert.h"
#include "convert/hidden_geometry.h"
#include "convert/profiles.h"
#include "tools/cli/outputs.h"
#include "tools/cli/recipe.h"
#include "tools/cli/session.h"
#include "tools/gltf_summary.h"

namespace wrlkit {

SaveOptions save_options(const Flags& flags) {
  SaveOptions out = flags.save;
  if (flags.pipeline_given) out.pipeline = flags.pipeline;
  const auto is_given = [&](std::string_view name) {
    return std::ranges::find(flags.given, name, &GivenOptions::value_type::first) != flags.given.end();
  };
  if (const Profile* profile = find_profile(flags.profile)) apply_profile(out, *profile, is_given);
  return out;
}

bool prepare_conversion(Session& s) {
  const auto& flags = s.flags();
  const auto options = save_options(flags);
  const auto to = output_of(flags.output, options);
  if (!to) {
    fmt::print(stderr, "wrlkit: '{}': what format is that? See wrlkit formats\n", flags.output);
    return false;
  }
  return s.good() && s.choose_pipeline(to->format->pipeline(options));
}

bool read_input(Session& s) {
  if (!s.read(s.flags().inputs[0]) || !check_input(s.document())) return false;
  const auto steps = s.pipeline().steps();
  if (std::ranges::find(steps, "switch", &Pipeline::StepInfo::name) == steps.end())
    report_hidden_geometry(s.world().scene, s.diag());
  return true;
}

Saved write_world(Session& s, SaveOptions options, const std::function<void(Scene&)>& last) {
  options.measure_gzip |= s.flags().verbose || s.flags().json;
  const auto to = output_of(s.flags().output, options);
  auto saved = write_document(s.document(), s.pipeline(), *to, options, {s.pipeline_options(), last});
  if (saved && saved.gltf) s.fact("gltf", summary_json(*saved.gltf));
  return saved;
}

int run_convert(const Flags& flags) {
  Session s(flags);
  if (!prepare_conversion(s)) return usage;
  if (flags.print_pipeline) {
    fmt::print("{}\n", s.pipeline().text());
    return done;
  }
  if (flags.print_recipe) {
    fmt::print("{}", recipe_text(flags.given, flags.warnings, s.pipeline()));
    return done;
  }
  Backup backup(flags);
  if (!backup.why_not().empty()) {
    fmt::print(stderr, "wrlkit: --in-place: {}\n", backup.why_not());
    return nothing;
  }
  const auto saved = read_input(s) ? write_world(s, save_options(flags)) : Saved{};
  if (saved) backup.keep();
  s.progress().clear();
  if (saved && flags.verbose && saved.gltf) fmt::print(stderr, "{}", summary_text(*saved.gltf));
  if (saved && flags.verbose) fmt::print(stderr, "{} -> {}\n", flags.inputs[0], flags.output);
  return s.end(static_cast<bool>(saved));
}

}  // namespace wrlkit

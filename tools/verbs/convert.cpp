// wrlkit convert: read, run the pipeline, write. The end of the output's name decides the format.
#include "tools/verbs/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "base/text/nearest_name.h"
#include "convert/convert.h"
#include "convert/hidden_geometry.h"
#include "convert/profiles.h"
#include "convert/startup_scripts.h"
#include "tools/cli/outputs.h"
#include "tools/cli/recipe.h"
#include "tools/cli/session.h"
#include "tools/gltf_summary.h"

namespace wrlkit {

namespace {

/// The ending of the name decides; --format where it has none.
std::optional<Output> chosen_output(const Flags& flags, const SaveOptions& options) {
  auto named = output_of(flags.output, options);
  if (!flags.is_given("format") || (named && flags.output != "-")) return named;
  auto to = output_of("x." + flags.format, options);
  if (to) to->path = flags.output;
  return to;
}

std::string no_format(const std::string& output) {
  for (const auto& format : formats())
    if (format.parsed != Format::none && !format.write && !ending_of(output, endings_of(format)).empty())
      return fmt::format("'{}': {} can be read, not written; its name should end in {}", output, format.name,
                         output_endings_text());
  const auto dot = output.rfind('.');
  NearestName nearest(dot == output.npos ? std::string_view() : std::string_view(output).substr(dot));
  for (auto ending : output_endings()) nearest.consider(ending);
  const auto question = nearest.question();
  return fmt::format("'{}': its name should end in {}{}", output, output_endings_text(),
                     question.empty() ? ", or --format should name the format" : question);
}

/// Names of options that have no effect on such an output, of those that were given.
std::vector<std::string> idle_options(const Flags& flags, const Output& to) {
  std::vector<std::string> names;
  const auto add = [&](std::string_view name, auto&&...) {
    if (flags.is_given(name)) names.emplace_back(name);
  };
  SaveOptions options;
  if (to.format->is_text) {
    options.light_fields(add);
    options.size_fields(add);
    add("profile");
  } else {
    options.text_fields(add);
  }
  using As = GltfOptions::Lightmaps;
  const As light = flags.save.lightmap_as;
  const bool is_combined = to.format->is_text ? !flags.save.dump : light == As::base_color || light == As::emissive;
  if (!is_combined) options.baked_fields(add);
  return names;
}

void warn_of_idle_options(const Flags& flags) {
  const auto to = chosen_output(flags, save_options(flags));
  for (const auto& name : idle_options(flags, *to))
    fmt::print(stderr, "wrlkit: --{} has no effect on {} output\n", name, to->format->name);
}

}  // namespace

SaveOptions save_options(const Flags& flags) {
  SaveOptions out = flags.save;
  if (flags.pipeline_given) out.pipeline = flags.pipeline;
  if (const Profile* profile = find_profile(flags.profile))
    apply_profile(out, *profile, [&](std::string_view name) { return flags.is_given(name); });
  return out;
}

bool prepare_conversion(Session& s) {
  const auto& flags = s.flags();
  const auto options = save_options(flags);
  const auto to = chosen_output(flags, options);
  if (!to) {
    fmt::print(stderr, "wrlkit: {}\n", no_format(flags.output));
    return false;
  }
  if (flags.output == "-" && flags.format == "gltf") {
    fmt::print(
        stderr,
        "wrlkit: --format gltf: its buffers are files next to it; write glb to standard output, or name a file\n");
    return false;
  }
  return s.good() && s.choose_pipeline(to->format->pipeline(options));
}

bool read_input(Session& s) {
  if (!s.read(s.flags().inputs[0]) || !check_input(s.document())) return false;
  const auto steps = s.pipeline().steps();
  const auto lacks = [&](std::string_view pass) {
    return std::ranges::find(steps, pass, &Pipeline::StepInfo::name) == steps.end();
  };
  if (lacks("switch") && lacks("startup")) report_hidden_geometry(s.world().scene, s.diag());
  if (lacks("startup")) report_startup_scripts(s.world().scene, s.diag());
  return true;
}

Saved write_world(Session& s, SaveOptions options, const std::function<void(Scene&)>& last) {
  options.measure_gzip |= s.flags().verbose || s.flags().json;
  const auto to = chosen_output(s.flags(), options);
  auto saved = write_document(s.document(), s.pipeline(), *to, options, {s.pipeline_options(), last});
  if (saved && saved.gltf) s.fact("gltf", summary_json(*saved.gltf));
  return saved;
}

int run_convert(const Flags& flags) {
  Session s(flags);
  if (!prepare_conversion(s)) return usage;
  if (s.printed_pipeline()) return done;
  if (flags.print_recipe) {
    fmt::print("{}", recipe_text(flags.given, flags.warnings, s.pipeline()));
    return done;
  }
  if (!flags.quiet) warn_of_idle_options(flags);
  Backup backup(flags);
  if (!backup.good()) return nothing;
  const auto saved = read_input(s) ? write_world(s, save_options(flags)) : Saved{};
  if (saved) backup.keep();
  s.progress().clear();
  if (saved && flags.verbose && saved.gltf) fmt::print(stderr, "{}", summary_text(*saved.gltf));
  if (saved && flags.verbose) fmt::print(stderr, "{} -> {}\n", flags.inputs[0], flags.output);
  return s.end(static_cast<bool>(saved));
}

}  // namespace wrlkit

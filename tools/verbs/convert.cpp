// wrlkit convert: read, run the pipeline, write. The end of the output's name decides the format.
#include "tools/verbs/convert.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/text/json.h"
#include "base/text/nearest_name.h"
#include "convert/convert.h"
#include "convert/missing_files.h"
#include "convert/profiles.h"
#include "convert/startup_scripts.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "tools/cli/outputs.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/recipe.h"
#include "tools/cli/session.h"
#include "tools/gltf_summary.h"
#include "tools/verbs/files_of_others.h"

namespace wrlkit {

namespace {

/// The ending of the name decides; --format where it has none.
std::optional<Output> chosen_output(const Flags& flags, const SaveOptions& options) {
  auto named = output_of(flags.output, options);
  if (!flags.is_given("format") || (named && flags.output != "-")) return named;
  if (!foreign_format(flags.output).empty()) return std::nullopt;  // "out.stl" would be taken for what it is not
  auto to = output_of("x." + flags.format, options);
  if (to) to->path = flags.output;
  return to;
}

std::string no_format(const std::string& output) {
  for (const auto& format : formats())
    if (format.parsed != Format::none && !format.write && !ending_of(output, endings_of(format)).empty())
      return fmt::format("'{}': {} can be read, not written; its name should end in {}", output, format.name,
                         output_endings_text());
  if (const auto foreign = foreign_format(output); !foreign.empty())
    return fmt::format("'{}': {} is not written; wrlkit writes {} (wrlkit formats), which most programs import", output,
                       foreign, output_endings_text());
  if (output.ends_with(".glb.gz") || output.ends_with(".gltf.gz"))
    return fmt::format("'{}': glTF is not packed by gzip, as viewers do not read that; --compress makes it small",
                       output);
  const auto dot = output.rfind('.');
  NearestName nearest(dot == output.npos ? std::string_view() : std::string_view(output).substr(dot));
  for (auto ending : output_endings()) nearest.consider(ending);
  const auto question = nearest.question();
  return fmt::format("'{}': its name should end in {}{}", output, output_endings_text(),
                     question.empty() ? ", or --format should name the format" : question);
}

/// An option that was given, and where it has no effect: "on VRML97 output", "without --compress".
struct IdleOption {
  std::string name, where;
};

/// Options of compression that it leaves without effect.
void add_idle_compression(const Flags& flags, GltfCompression::Method method, std::vector<IdleOption>& out) {
  using Method = GltfCompression::Method;
  constexpr std::string_view of_any[] = {"tolerance", "position-bits", "normal-bits", "texcoord-bits", "color-bits"};
  for (const auto name : of_any)
    if (method == Method::none && flags.is_given(name)) out.push_back({std::string(name), "without --compress"});
  if (method != Method::draco && flags.is_given("draco-level"))
    out.push_back({"draco-level", "without --compress draco"});
  using Format = GltfTextures::Format;
  const auto format = save_options(flags).texture_format;
  if (flags.is_given("texture-quality") && (format == Format::keep || format == Format::png))
    out.push_back({"texture-quality", "without --texture-format jpeg or webp"});
}

std::vector<IdleOption> idle_options(const Flags& flags, const Output& to) {
  std::vector<IdleOption> out;
  const auto add = [&](std::string_view name, auto&&...) {
    if (flags.is_given(name)) out.push_back({std::string(name), fmt::format("on {} output", to.format->name)});
  };
  SaveOptions options;
  if (to.format->is_text) {
    options.light_fields(add);
    options.size_fields(add);
    add("profile");
  } else {
    options.text_fields(add);
    add_idle_compression(flags, save_options(flags).compress, out);
  }
  using As = GltfOptions::Lightmaps;
  const As light = flags.save.lightmap_as;
  const bool is_combined = to.format->is_text ? !flags.save.dump : light == As::base_color || light == As::emissive;
  if (!is_combined) options.baked_fields(add);
  if (flags.is_given("format") && flags.output != "-" && output_of(flags.output) &&
      output_of("x." + flags.format)->format != to.format)
    out.push_back({"format", fmt::format("on '{}', whose name says {}", flags.output, to.format->name)});
  return out;
}

}  // namespace

SaveOptions save_options(const Flags& flags) {
  SaveOptions out = flags.save;
  if (flags.pipeline_given) out.pipeline = flags.pipeline;
  if (const Profile* profile = find_profile(flags.profile))
    apply_profile(out, *profile, [&](std::string_view name) { return flags.is_given(name); });
  return out;
}

void warn_of_idle_options(const Flags& flags) {
  if (flags.quiet) return;
  const auto to = chosen_output(flags, save_options(flags));
  for (const auto& [name, where] : idle_options(flags, *to))
    fmt::print(stderr, "wrlkit: --{} has no effect {}\n", name, where);
}

void warn_of_files_outside(Session& s, const Output& to, const SaveOptions& options) {
  const bool is_alone = options.embed || options.link || options.dump || options.is_mirrored;
  if (to.path != "-" || !to.format->is_text || is_alone || s.flags().quiet || isatty(STDOUT_FILENO) != 0) return;
  const auto files = files_outside(s.world().scene, s.resources());
  if (files.empty()) return;
  constexpr std::size_t most = 3;
  std::string names;
  for (const auto& file : std::span(files).first(std::min(most, files.size())))
    names += (names.empty() ? "'" : ", '") + file + "'";
  fmt::print(
      stderr,
      "wrlkit: warning: standard output refers to {}{}, by urls from the folder of the input; --embed includes them\n",
      names, files.size() > most ? fmt::format(" and {} more", files.size() - most) : "");
}

std::string facts_json(Session& s, const Output& to, const Saved& saved) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("input", s.flags().inputs[0], "output", s.flags().output, "format", to.format->name, "written",
                   static_cast<bool>(saved));
      if (saved.gltf) json.member("gltf", JsonText{summary_json(*saved.gltf)});
      json.member("messages", JsonText{messages_json(s.diag())});
    });
  });
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
  if (!s.runs("startup")) report_startup_scripts(s.world().scene, s.diag());
  return true;
}

Saved write_world(Session& s, SaveOptions options, const std::function<void(Scene&)>& last) {
  options.measure_gzip |= s.flags().verbose || s.flags().json;
  const auto to = chosen_output(s.flags(), options);
  auto saved = write_document(s.document(), s.pipeline(), *to, options, {s.pipeline_options(), last});
  if (saved && saved.gltf) s.fact("gltf", summary_json(*saved.gltf));
  if (saved) warn_of_files_outside(s, *to, options);
  return saved;
}

/// How light is written that there is not.
void warn_of_no_light(const Session& s, const Scene& scene) {
  if (!s.flags().is_given("lightmap-as") || s.flags().quiet || s.runs("lightmap")) return;
  const auto may_have = [&](NodeId n) {
    return scene.is(n, nodes::Inline) || (scene.is(n, nodes::Appearance) && scene.get(n, nodes::appearance::lightmap));
  };
  if (!any_node(scene, may_have))
    fmt::print(stderr,
               "wrlkit: --lightmap-as has no effect: nothing in the scene has a lightmap; -p lightmap bakes "
               "one\n");
}

int run_convert(const Flags& flags) {
  Session s(flags);
  if (!prepare_conversion(s)) return usage;
  if (s.printed_pipeline()) return done;
  if (flags.print_recipe) {
    fmt::print("{}", recipe_text(flags.given, flags.warnings, s.pipeline()));
    return done;
  }
  const auto to = *chosen_output(flags, save_options(flags));
  if (!check_buffer(flags, to)) return usage;
  warn_of_idle_options(flags);
  Backup backup(flags);
  if (!backup.good()) return nothing;
  const bool is_read = read_input(s);
  if (is_read) warn_of_no_light(s, s.world().scene);
  if (is_read) keep_files_of_others(s, to);
  const auto saved = is_read ? write_world(s, save_options(flags)) : Saved{};
  if (saved) backup.keep();
  s.progress().clear();
  if (saved && flags.verbose && saved.gltf) fmt::print(stderr, "{}", summary_text(*saved.gltf));
  if (saved && flags.verbose) fmt::print(stderr, "{} -> {}\n", flags.inputs[0], flags.output);
  if (flags.json) s.print_json(facts_json(s, to, saved));
  return s.end(static_cast<bool>(saved));
}

}  // namespace wrlkit

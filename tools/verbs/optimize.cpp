// wrlkit optimize: share what is equal, write it small, and say what that did.
#include <fmt/format.h>

#include <filesystem>

#include "base/text/json.h"
#include "convert/optimize.h"
#include "tools/cli/outputs.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/gltf_summary.h"
#include "tools/verbs/convert.h"
#include "tools/verbs/files_of_others.h"

namespace wrlkit {
namespace {

std::string names_text(const Optimized& made) {
  std::string out = fmt::format("  different names: {} of {} kept",
                                made.n_names - made.lost.size() - made.not_shown.size(), made.n_names);
  if (!made.not_shown.empty()) out += fmt::format("; {} are only of nodes that no Switch shows", made.not_shown.size());
  return out + '\n';
}

/// A .glb as it is on disk; of a .gltf, with files next to it, what they hold together.
std::uint64_t bytes_after(const Session& s, const Optimized& made) {
  std::error_code none;
  const bool is_glb = output_of(s.flags().output)->format->endings != ".gltf";
  const auto size = is_glb ? std::filesystem::file_size(s.flags().output, none) : 0;
  return is_glb && !none ? size : made.gltf->bytes();
}

std::string text(const Session& s, std::uint64_t before, const Optimized& made) {
  return fmt::format("{} ({} bytes) -> {} ({} bytes)\n{}{}", s.flags().inputs[0], before, s.flags().output,
                     bytes_after(s, made), summary_text(*made.gltf), names_text(made));
}

/// What was made, and all messages; of an input that nothing could be made of, the messages alone.
std::string figures_json(Session& s, std::uint64_t before, const Optimized& made) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("input", s.flags().inputs[0], "output", s.flags().output, "profile", s.flags().profile);
      if (made) {
        json.members("bytes_before", before, "bytes_after", bytes_after(s, made), "names_before", made.n_names,
                     "names_lost", std::span<const std::string>(made.lost), "names_not_shown",
                     std::span<const std::string>(made.not_shown));
        json.member("gltf", JsonText{summary_json(*made.gltf)});
      }
      json.member("messages", JsonText{messages_json(s.diag())});
    });
  });
}

}  // namespace

int run_optimize(const Flags& given) {
  Flags flags = given;
  const Profile* profile = find_profile(flags.profile.empty() ? "three" : flags.profile);
  flags.profile = profile->name;
  if (flags.print_profile) {
    fmt::print("{}", profile_text(*profile));
    return done;
  }
  if (flags.inputs.empty() || flags.output.empty()) {
    fmt::print(stderr, "wrlkit: optimize needs IN and OUT\n");
    return usage;
  }
  if (!flags.pipeline_given) {
    flags.pipeline = flags.recognise ? recognising(*profile) : std::string(profile->pipeline);
    flags.pipeline_given = true;
  }
  Session s(flags);
  auto options = save_options(flags);
  if (!prepare_conversion(s)) return usage;
  if (!output_of(flags.output)->format->meshes) {
    fmt::print(stderr, "wrlkit: optimize writes .glb and .gltf, not '{}'\n", flags.output);
    return usage;
  }
  if (s.printed_pipeline()) return done;
  if (!check_buffer(flags, *output_of(flags.output))) return usage;
  warn_of_idle_options(flags);
  Backup backup(flags);
  if (!backup.good()) return nothing;
  options.measure_gzip = !flags.quiet;
  std::uint64_t before = 0;
  Optimized made;
  if (read_input(s)) {
    before = s.world().bytes;
    keep_files_of_others(s, *output_of(flags.output));
    made = optimize(s.document(), s.pipeline(), *output_of(flags.output), options, {s.pipeline_options()});
  }
  if (made) {
    backup.keep();
    s.fact("gltf", summary_json(*made.gltf));
  }
  s.progress().clear();
  if (flags.json)
    s.print_json(figures_json(s, before, made));
  else if (made && !flags.quiet)
    fmt::print(stderr, "{}", text(s, before, made));
  return s.end(static_cast<bool>(made));
}

}  // namespace wrlkit

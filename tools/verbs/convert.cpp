// wrlkit convert: read, run the pipeline, write. The end of the output's name decides the format.
#include "tools/verbs/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scenegraph/verify.h"
#include "tools/cli/recipe.h"
#include "tools/cli/session.h"
#include "tools/gltf_output.h"
#include "tools/vrml_file.h"

namespace wrlkit {
namespace {

enum class Target : std::uint8_t { glb, gltf, vrml, x3d };

std::optional<Target> target_of(std::string name, bool& gzip) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with(".gz")) {
    gzip = true;
    name.resize(name.size() - 3);
  }
  if (name.ends_with(".wrz")) {
    gzip = true;
    return Target::vrml;
  }
  if (name.ends_with(".x3dz")) {
    gzip = true;
    return Target::x3d;
  }
  if (name.ends_with(".x3d")) return Target::x3d;
  if (name.ends_with(".wrl") || name.ends_with(".vrml")) return Target::vrml;
  if (gzip) return std::nullopt;
  if (name.ends_with(".glb") || name == "-") return Target::glb;
  if (name.ends_with(".gltf")) return Target::gltf;
  return std::nullopt;
}

bool write_as_text(Session& s, bool gzip, Target target, const std::function<void(Scene&)>& last) {
  if (!s.pipeline().run(s.world().scene, s.context(), s.pipeline_options())) return false;
  if (last) last(s.world().scene);
  return (target == Target::x3d ? write_x3d_file : write_vrml_file)(s, s.world().scene, s.flags().output, gzip);
}

bool write_as_gltf(Session& s) {
  GltfSummary summary;
  if (!write_gltf_file(s, *gltf_options(s.flags()), summary)) return false;
  s.progress().clear();
  if (s.flags().verbose) fmt::print(stderr, "{}", summary_text(summary));
  return true;
}

/// The pipeline that prepares a scene for its writer.
std::string_view pipeline_for(Target target, const Flags& flags) {
  if (target == Target::glb || target == Target::gltf) return gltf_pipeline(flags);
  return target == Target::x3d && !flags.dump ? "x3d" : vrml_pipeline(flags);
}

}  // namespace

bool is_output_name(const std::string& name) {
  bool gzip = false;
  return target_of(name, gzip).has_value();
}

bool prepare_conversion(Session& s) {
  const auto& flags = s.flags();
  bool gzip = flags.gzip;
  const auto target = target_of(flags.output, gzip);
  if (!target) {
    fmt::print(stderr, "wrlkit: '{}': what format is that? See wrlkit formats\n", flags.output);
    return false;
  }
  return s.good() && gltf_options(flags) && s.choose_pipeline(pipeline_for(*target, flags));
}

bool convert_world(Session& s) { return read_input(s) && write_world(s); }

bool read_input(Session& s) {
  const auto& flags = s.flags();
  if (!s.read(flags.inputs[0])) return false;
  check_values(s.world().scene, s.diag());
  const auto& main = s.world().scene.main;
  if (main.roots.empty() && main.protos.empty() && s.diag().has_errors()) {
    s.diag().report(Diag::nothing_to_write, {});
    return false;
  }
  return true;
}

bool write_world(Session& s, const std::function<void(Scene&)>& last) {
  bool gzip = s.flags().gzip;
  const auto target = target_of(s.flags().output, gzip);
  return *target == Target::vrml || *target == Target::x3d ? write_as_text(s, gzip, *target, last) : write_as_gltf(s);
}

int run_convert(const Flags& given) {
  Flags flags = given;
  apply_profile(flags);
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
  const bool made = convert_world(s);
  s.progress().clear();
  if (made && flags.verbose) fmt::print(stderr, "{} -> {}\n", flags.inputs[0], flags.output);
  return s.end(made);
}

}  // namespace wrlkit

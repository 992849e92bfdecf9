// wrlkit convert: read, run the pipeline, write. The end of the output's name decides the format.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scenegraph/verify.h"
#include "scenegraph/walk.h"
#include "tools/gltf_output.h"
#include "tools/recipe.h"
#include "tools/session.h"
#include "tools/vrml_file.h"
#include "writers/gltf.h"
#include "writers/made_files.h"

namespace wrlkit {
namespace {

enum class Target : std::uint8_t { glb, gltf, vrml, x3d };

std::optional<Target> target_of(std::string name, bool& gzip) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with(".gz")) gzip = true, name.resize(name.size() - 3);
  if (name.ends_with(".wrz")) return gzip = true, Target::vrml;
  if (name.ends_with(".x3dz")) return gzip = true, Target::x3d;
  if (name.ends_with(".x3d")) return Target::x3d;
  if (name.ends_with(".wrl") || name.ends_with(".vrml")) return Target::vrml;
  if (gzip) return std::nullopt;
  if (name.ends_with(".glb") || name == "-") return Target::glb;
  if (name.ends_with(".gltf")) return Target::gltf;
  return std::nullopt;
}

struct LightRow {
  std::string_view name;
  GltfOptions::Lightmaps as;
  std::string_view pipeline;
};

/// What --lightmap-as says.
const LightRow* light_of(std::string_view name) {
  using As = GltfOptions::Lightmaps;
  static constexpr LightRow rows[] = {{"base-color", As::base_color, "gltf"},
                                      {"emissive", As::emissive, "gltf-emissive"},
                                      {"occlusion", As::occlusion, "gltf-light"},
                                      {"moz", As::moz, "gltf-light"},
                                      {"extras", As::extras, "gltf-light"}};
  return std::ranges::find(rows, name, &LightRow::name);
}

std::size_t count_geometries(const Scene& scene) {
  return static_cast<std::size_t>(std::ranges::count_if(reachable(scene, scene.main), [&](NodeId n) { return scene.type(n).is_a("X3DGeometryNode"); }));
}

bool write_as_text(Session& s, bool gzip, Target target) {
  if (!s.pipeline().run(s.world().scene, s.context(), s.pipeline_options())) return false;
  return (target == Target::x3d ? write_x3d_file : write_vrml_file)(s, s.world().scene, s.flags().output, gzip);
}

/// A glTF without meshes is what some worlds deserve (lights, PROTO libraries), but nobody should find it out later.
void say_why_empty(const Scene& scene, Diagnostics& diag) {
  const auto& roots = scene.main.roots;
  if (diag.count(Diag::unknown_node) > 0) diag.report(Diag::nothing_drawn, roots.empty() ? Span{} : scene.where(roots[0]), "it has no geometry, but nodes that are not known");
  else if (roots.empty()) diag.report(Diag::nothing_drawn, Span{}, "it holds no node");
}

bool write_as_gltf(Session& s, bool binary) {
  Scene& scene = s.world().scene;
  auto meshes = s.pipeline().run_lazily(scene, s.context(), s.pipeline_options());
  if (!meshes) return false;
  const auto n_geometries = count_geometries(scene);
  if (n_geometries == 0) say_why_empty(scene, s.diag());
  s.progress().begin("writing " + s.flags().output, n_geometries, "shapes");
  auto counted = [&](NodeId n) -> const Mesh& { return s.progress().step(), meshes(n); };
  MadeFiles beside(scene, s.resources(), s.flags().output, s.diag());  // pictures are glTF's own matter; the rest is here
  const GltfOptions options{.binary = binary, .lightmaps = light_of(s.flags().lightmap_as)->as, .compression = *compression_of(s.flags()), .measure_gzip = s.flags().verbose || s.flags().json};
  GltfSummary summary;
  if (!beside.write() || !write_gltf(scene, counted, options, &s.resources(), s.flags().output, s.diag(), &summary) || !beside.commit()) return false;
  s.fact("gltf", summary_json(summary));
  if (s.flags().verbose) fmt::print(stderr, "{}", summary_text(summary));
  return true;
}

/// The pipeline that prepares a scene for its writer.
std::string_view pipeline_for(Target target, const Flags& flags) {
  if (target == Target::glb || target == Target::gltf) return light_of(flags.lightmap_as)->pipeline;
  return target == Target::x3d && !flags.dump ? "x3d" : vrml_pipeline(flags);
}

}  // namespace

int run_convert(const Flags& flags) {
  Session s(flags);
  bool gzip = flags.gzip;
  auto target = target_of(flags.output, gzip);
  if (!target) return fmt::print(stderr, "wrlkit: '{}': what format is that? See wrlkit formats\n", flags.output), usage;
  if (!s.good() || !compression_of(flags) || !s.choose_pipeline(pipeline_for(*target, flags))) return usage;
  if (flags.print_pipeline) return fmt::print("{}\n", s.pipeline().text()), done;
  if (flags.print_recipe) return fmt::print("{}", recipe_text(flags.given, flags.warnings, s.pipeline())), done;
  if (!s.read(flags.inputs[0])) return s.end(false);
  check_values(s.world().scene, s.diag());
  const auto& main = s.world().scene.main;
  if (main.roots.empty() && main.protos.empty() && s.diag().has_errors()) return s.diag().report(Diag::nothing_to_write, {}), s.end(false);
  bool made = *target == Target::vrml || *target == Target::x3d ? write_as_text(s, gzip, *target) : write_as_gltf(s, *target == Target::glb);
  if (made && flags.verbose) fmt::print(stderr, "{} -> {}\n", flags.inputs[0], flags.output);
  return s.end(made);
}

}  // namespace wrlkit

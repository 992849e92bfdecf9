// wrlkit convert: read, run the pipeline, write. The end of the output's name decides the format.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "scenegraph/verify.h"
#include "scenegraph/walk.h"
#include "tools/session.h"
#include "writers/gltf.h"
#include "writers/output.h"
#include "writers/vrml.h"

namespace wrlkit {
namespace {

enum class Target : std::uint8_t { glb, gltf, vrml };

std::optional<Target> target_of(std::string name, bool& gzip) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with(".gz")) gzip = true, name.resize(name.size() - 3);
  if (name.ends_with(".wrz")) return gzip = true, Target::vrml;
  if (name.ends_with(".wrl") || name.ends_with(".vrml")) return Target::vrml;
  if (gzip) return std::nullopt;
  if (name.ends_with(".glb") || name == "-") return Target::glb;
  if (name.ends_with(".gltf")) return Target::gltf;
  return std::nullopt;
}

std::size_t count_geometries(const Scene& scene) {
  return static_cast<std::size_t>(std::ranges::count_if(reachable(scene, scene.main), [&](NodeId n) { return scene.type(n).is_a("X3DGeometryNode"); }));
}

bool write_as_vrml(Session& s, bool gzip) {
  if (!s.pipeline().run(s.world().scene, s.context(), s.pipeline_options())) return false;
  auto file = OutputFile::open(s.flags().output, {.gzip = gzip}, s.diag());
  if (!file) return false;
  write_vrml(s.world().scene, {.precision = s.flags().precision, .file = s.flags().output}, file->sink(), s.diag());
  return file->commit(s.diag());
}

bool write_as_gltf(Session& s, bool binary) {
  Scene& scene = s.world().scene;
  auto meshes = s.pipeline().run_lazily(scene, s.context(), s.pipeline_options());
  if (!meshes) return false;
  const auto n_geometries = count_geometries(scene);
  if (n_geometries == 0 && s.diag().count(Diag::unknown_node) > 0) s.diag().report(Diag::nothing_drawn, scene.main.roots.empty() ? Span{} : scene.where(scene.main.roots[0]));
  s.progress().begin("writing " + s.flags().output, n_geometries, "shapes");
  auto counted = [&](NodeId n) -> const Mesh& { return s.progress().step(), meshes(n); };
  return write_gltf(scene, counted, {.binary = binary}, &s.resources(), s.flags().output, s.diag());
}

}  // namespace

int run_convert(const Flags& flags) {
  Session s(flags);
  bool gzip = flags.gzip;
  auto target = target_of(flags.output, gzip);
  if (!target) return fmt::print(stderr, "wrlkit: '{}': what format is that? See wrlkit formats\n", flags.output), usage;
  if (!s.good() || !s.choose_pipeline(*target != Target::vrml ? "gltf" : flags.pipeline == "none" ? "none" : "vrml")) return usage;
  if (flags.print_pipeline) return fmt::print("{}\n", s.pipeline().text()), done;
  if (!s.read(flags.inputs[0])) return s.end(false);
  check_values(s.world().scene, s.diag());
  const auto& main = s.world().scene.main;
  if (main.roots.empty() && main.protos.empty() && s.diag().has_errors()) return s.diag().report(Diag::nothing_to_write, {}), s.end(false);
  bool made = *target == Target::vrml ? write_as_vrml(s, gzip) : write_as_gltf(s, *target == Target::glb);
  if (made && flags.verbose) fmt::print(stderr, "{} -> {}\n", flags.inputs[0], flags.output);
  return s.end(made);
}

}  // namespace wrlkit
